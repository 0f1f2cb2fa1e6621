"""Tables of the documentation, computed by the code that they describe."""
