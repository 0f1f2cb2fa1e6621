"""What steering laws do, when to choose which, and what the papers claim of them."""
