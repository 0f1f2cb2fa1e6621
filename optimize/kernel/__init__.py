"""Compiled scores of formations, for searches that are long enough to pay for the compiler."""

from .evaluator import CompiledEvaluator, compiled_evaluator

__all__ = ["CompiledEvaluator", "compiled_evaluator"]
