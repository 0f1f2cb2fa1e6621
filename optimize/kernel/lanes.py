"""Eight formations side by side: one number of each in a vector register of the processor.

Numba has no such type, so this gives it one: `LANES` with arithmetic, and functions that read and
write it. What every other module of the kernel writes as a formula of numbers is then computed for
eight formations at once, with no loop over formations for a compiler to vectorize or not. Each lane
is computed alone, by IEEE arithmetic: a formation has the same bits in any place of any batch.

Arrays go by the address of their first element. Handed on as arrays, they would have their
references counted at each call, which takes longer than the physics.
"""

from __future__ import annotations

import operator

import numba
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typeconv import Conversion
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, lower_cast, models, register_model

from .rooms import WIDTH

if numba.config.DISABLE_JIT:
    raise ImportError("numba compiles nothing: NUMBA_DISABLE_JIT is set")

jit = numba.njit(nogil=True, error_model="numpy")

_DOUBLE, _INTEGER = ir.DoubleType(), ir.IntType(64)
_VECTOR, _INTEGERS = ir.VectorType(_DOUBLE, WIDTH), ir.VectorType(_INTEGER, WIDTH)
_FUSED = ("contract",)  # a·b + c may round once


class _Lanes(types.Type):
    """A number of each of eight formations."""

    def __init__(self):
        super().__init__(name="Lanes")

    def can_convert_from(self, _context, other):
        """Numbers that are the same for all eight."""
        return Conversion.safe if isinstance(other, types.Float | types.Integer) else None

    def unify(self, _context, other):
        """A variable that is once a number and once one of each is the latter."""
        return self if isinstance(other, types.Float | types.Integer) else None


LANES = _Lanes()


@register_model(_Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager, frontend_type):
        super().__init__(manager, frontend_type, _VECTOR)


def _all(builder, number):
    """The same number in every lane."""
    place = ir.Constant(ir.IntType(32), 0)
    first = builder.insert_element(ir.Constant(_VECTOR, ir.Undefined), number, place)
    return builder.shuffle_vector(
        first,
        ir.Constant(_VECTOR, ir.Undefined),
        ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), [0] * WIDTH),
    )


@lower_cast(types.Float, _Lanes)
@lower_cast(types.Integer, _Lanes)
def _cast(context, builder, given, _lanes, value):
    return _all(builder, context.cast(builder, value, given, types.float64))


def _arithmetic(operation, instruction):
    @infer_global(operation)
    class _Typing(ConcreteTemplate):
        cases = [signature(LANES, LANES, LANES)]  # noqa: RUF012

    @lower_builtin(operation, _Lanes, _Lanes)
    def _lower(_context, builder, _signature, arguments):
        return getattr(builder, instruction)(*arguments, flags=_FUSED)


for _operation, _instruction in (
    (operator.add, "fadd"),
    (operator.iadd, "fadd"),
    (operator.sub, "fsub"),
    (operator.isub, "fsub"),
    (operator.mul, "fmul"),
    (operator.imul, "fmul"),
    (operator.truediv, "fdiv"),
):
    _arithmetic(_operation, _instruction)


def _place(builder, address, index, kind):
    """Pointer to an element of an array of doubles, integers or vectors."""
    start = builder.inttoptr(address, ir.PointerType(kind))
    return builder.gep(start, [index], source_etype=kind)


@intrinsic
def every(_context, value):
    """The same number for all eight."""

    def generate(_context, _builder, _signature, arguments):
        return arguments[0]  # the conversion to the type of the signature has made it

    return LANES(LANES), generate


@intrinsic
def lanes(_context, address, index):
    """The eight numbers at a place of an array of them."""

    def generate(_context, builder, _signature, arguments):
        return builder.load(_place(builder, *arguments, _VECTOR), align=8, typ=_VECTOR)

    return LANES(types.int64, types.int64), generate


@intrinsic
def keep(_context, address, index, value):
    """Write eight numbers to a place of an array of them."""

    def generate(context, builder, _signature, arguments):
        builder.store(arguments[2], _place(builder, *arguments[:2], _VECTOR), align=8)
        return context.get_dummy_value()

    return types.none(types.int64, types.int64, LANES), generate


@intrinsic
def number(_context, address, index):
    """One number of an array."""

    def generate(_context, builder, _signature, arguments):
        return builder.load(_place(builder, *arguments, _DOUBLE), typ=_DOUBLE)

    return types.float64(types.int64, types.int64), generate


@intrinsic
def put(_context, address, index, value):
    """Write one number of an array."""

    def generate(context, builder, _signature, arguments):
        builder.store(arguments[2], _place(builder, *arguments[:2], _DOUBLE))
        return context.get_dummy_value()

    return types.none(types.int64, types.int64, types.float64), generate


@intrinsic
def integer(_context, address, index):
    """One integer of an array."""

    def generate(_context, builder, _signature, arguments):
        return builder.load(_place(builder, *arguments, _INTEGER), typ=_INTEGER)

    return types.int64(types.int64, types.int64), generate


@intrinsic
def put_integer(_context, address, index, value):
    """Write one integer of an array."""

    def generate(context, builder, _signature, arguments):
        builder.store(arguments[2], _place(builder, *arguments[:2], _INTEGER))
        return context.get_dummy_value()

    return types.none(types.int64, types.int64, types.int64), generate


@intrinsic
def pick(_context, address, first, row, columns, column):
    """Numbers of a table at rows `first + row` that differ from lane to lane, and one column."""

    def generate(_context, builder, _signature, arguments):
        address, first, row, columns, column = arguments
        rows = builder.fptosi(row, _INTEGERS)
        result = ir.Constant(_VECTOR, ir.Undefined)
        for lane in range(WIDTH):
            place = ir.Constant(ir.IntType(32), lane)
            index = builder.add(first, builder.extract_element(rows, place))
            index = builder.add(builder.mul(index, columns), column)
            value = builder.load(_place(builder, address, index, _DOUBLE), typ=_DOUBLE)
            result = builder.insert_element(result, value, place)
        return result

    whole = types.int64
    return LANES(whole, whole, LANES, whole, whole), generate


def record(dtype):
    """A function from the address of a record to the record."""
    kind = numba.from_dtype(dtype)

    @intrinsic
    def at(_context, address):
        """The record at an address."""

        def generate(context, builder, _signature, arguments):
            return builder.inttoptr(arguments[0], context.get_value_type(kind))

        return kind(types.int64), generate

    return at


def _selecting(comparison):
    """where(a ? b, x, y), lane by lane."""

    def generate(_context, builder, _signature, arguments):
        a, b, x, y = arguments
        return builder.select(builder.fcmp_ordered(comparison, a, b), x, y)

    return LANES(LANES, LANES, LANES, LANES), generate


@intrinsic
def where_less(_context, a, b, x, y):
    """Where a < b take x, elsewhere y."""
    return _selecting("<")


@intrinsic
def where_equal(_context, a, b, x, y):
    """Where a = b take x, elsewhere y."""
    return _selecting("==")


@intrinsic
def larger(_context, a, b):
    """The larger of two in each lane; b where one is not a number."""

    def generate(_context, builder, _signature, arguments):
        return builder.select(builder.fcmp_ordered(">", *arguments), *arguments)

    return LANES(LANES, LANES), generate


@intrinsic
def smaller(_context, a, b):
    """The smaller of two in each lane; b where one is not a number."""

    def generate(_context, builder, _signature, arguments):
        return builder.select(builder.fcmp_ordered("<", *arguments), *arguments)

    return LANES(LANES, LANES), generate


def _of_llvm(name):
    """A function of LLVM's, which calls the one of the C library for each lane if it must."""

    def generate(_context, builder, _signature, arguments):
        kind = ir.FunctionType(_VECTOR, [_VECTOR])
        called = f"llvm.{name}.v{WIDTH}f64"
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, called), arguments)

    return LANES(LANES), generate


@intrinsic
def root(_context, value):
    """Square roots."""
    return _of_llvm("sqrt")


@intrinsic
def magnitude(_context, value):
    """Absolute values."""
    return _of_llvm("fabs")


@intrinsic
def floor(_context, value):
    """Largest integers below."""
    return _of_llvm("floor")


@intrinsic
def exponential(_context, value):
    """Exponentials, by the C library."""
    return _of_llvm("exp")


@intrinsic
def logarithm(_context, value):
    """Natural logarithms, by the C library."""
    return _of_llvm("log")


@intrinsic
def power_of_two(_context, exponent):
    """2 to the power of whole numbers from −1022 to 1023, by the bits of the format."""

    def generate(_context, builder, _signature, arguments):
        # Added to 1.5·2⁵², the number stands in the lowest bits of the fraction.
        shift = ir.Constant(_VECTOR, [1.5 * 2.0**52 + 1023.0] * WIDTH)
        bits = builder.bitcast(builder.fadd(arguments[0], shift), _INTEGERS)
        bits = builder.shl(bits, ir.Constant(_INTEGERS, [52] * WIDTH))
        return builder.bitcast(bits, _VECTOR)

    return LANES(LANES), generate
