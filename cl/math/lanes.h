/* One value per path of a work-item: Float Int Uint Mask. The only file that asks how many lanes there are.
 *
 * LANES is 1, 4, 8 or 16. With one lane the types are scalars. A Mask is the result of a comparison: 0 or 1 in scalar
 * code, 0 or -1 per lane in vectors; so `m ? a : b`, `&` and `|` work on both, and not(m) replaces ! and ~. */
#pragma once
#include "shared/real.h"

/* Functions of parts: private to the program and always inlined (a call left over costs PoCL its vectors). */
#define STATIC static inline __attribute__((always_inline))

#define LANES_JOIN_(a, b) a##b
#define LANES_JOIN(a, b) LANES_JOIN_(a, b)

#if LANES == 1

typedef real Float;
typedef int Int;
typedef uint Uint;
typedef int Mask;

#define to_float(x) ((Float)(x))
#define to_int(x) ((Int)(x))
#define to_uint(x) ((Uint)(x))
#define int_bits(x) as_int(x)
#define uint_bits(x) as_uint(x)
#if REAL_IS_DOUBLE
/* The bits of a Float do not fit a Uint: int_bits and uint_bits are for the integers only. */
#define ulong_bits(x) as_ulong(x)
#else
#define from_bits(x) as_float(x)
#endif
#define to_mask(m) ((Mask)(m))

STATIC Mask not(Mask m)
{
    return !m;
}
STATIC uint lane_bits(Mask m)
{
    return m ? 1u : 0u;
}
STATIC Uint lane_numbers(void)
{
    return 0u;
}

/* high and low words of the product of a 32-bit constant and a value */
STATIC void multiply_wide(uint constant_factor, Uint x, Uint* high, Uint* low)
{
    *high = mul_hi(constant_factor, x);
    *low = constant_factor * x;
}

#else

#if REAL_IS_DOUBLE
#error "The fp64 twin runs with one lane."
#endif

typedef LANES_JOIN(float, LANES) Float;
typedef LANES_JOIN(int, LANES) Int;
typedef LANES_JOIN(uint, LANES) Uint;
typedef LANES_JOIN(int, LANES) Mask;

#define to_float(x) LANES_JOIN(convert_float, LANES)(x)
#define to_int(x) LANES_JOIN(convert_int, LANES)(x)
#define to_uint(x) LANES_JOIN(convert_uint, LANES)(x)
#define int_bits(x) LANES_JOIN(as_int, LANES)(x)
#define uint_bits(x) LANES_JOIN(as_uint, LANES)(x)
#define from_bits(x) LANES_JOIN(as_float, LANES)(x)
/* every lane alike, from a uniform 0 or 1 */
#define to_mask(m) ((Mask)((m) ? -1 : 0))

STATIC Mask not(Mask m)
{
    return ~m;
}

/* Gather the sign bits of a mask into one word, lane 0 lowest. */
STATIC uint lane_bits_4(int4 m)
{
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (uint)(uchar)__builtin_ia32_cvtd2mask128(m);
#else
    return (((as_uint(convert_char4(m)) & 0x01010101u) * 0x01020408u) >> 24) & 15u;
#endif
}
STATIC uint lane_bits_8(int8 m)
{
#ifdef __AVX512DQ__
    return (uint)(uchar)__builtin_ia32_cvtd2mask256(m);
#else
    return (uint)(((as_ulong(convert_char8(m)) & 0x0101010101010101ul) * 0x0102040810204080ul) >> 56);
#endif
}
STATIC uint lane_bits_16(int16 m)
{
#ifdef __AVX512DQ__
    return (uint)(ushort)__builtin_ia32_cvtd2mask512(m);
#else
    return lane_bits_8(m.lo) | (lane_bits_8(m.hi) << 8);
#endif
}

#if LANES == 4
STATIC uint lane_bits(Mask m)
{
    return lane_bits_4(m);
}
STATIC Uint lane_numbers(void)
{
    return (Uint)(0, 1, 2, 3);
}
STATIC void multiply_wide(uint constant_factor, Uint x, Uint* high, Uint* low)
{
    *high = mul_hi((Uint)(constant_factor), x);
    *low = constant_factor * x;
}
#else
/* Multiply even and odd lanes as 64-bit integers: one instruction each, where mul_hi is a loop on PoCL. */
#if LANES == 8
typedef ulong4 UlongHalf;
#define as_pairs(x) as_ulong4(x)
STATIC uint lane_bits(Mask m)
{
    return lane_bits_8(m);
}
STATIC Uint lane_numbers(void)
{
    return (Uint)(0, 1, 2, 3, 4, 5, 6, 7);
}
#elif LANES == 16
typedef ulong8 UlongHalf;
#define as_pairs(x) as_ulong8(x)
STATIC uint lane_bits(Mask m)
{
    return lane_bits_16(m);
}
STATIC Uint lane_numbers(void)
{
    return (Uint)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
#else
#error "LANES must be 1, 4, 8 or 16."
#endif
STATIC void multiply_wide(uint constant_factor, Uint x, Uint* high, Uint* low)
{
    UlongHalf pairs = as_pairs(x);
    UlongHalf even = (pairs & 0xfffffffful) * (ulong)constant_factor;
    UlongHalf odd = (pairs >> 32) * (ulong)constant_factor;
    *high = uint_bits((even >> 32) | (odd & 0xffffffff00000000ul));
    *low = uint_bits((even & 0xfffffffful) | (odd << 32));
}
#endif

#endif

/* The bits of lane_bits when every lane is set. */
#define ALL_LANES ((1u << LANES) - 1u)

STATIC bool any_of(Mask m)
{
    return lane_bits(m) != 0u;
}
STATIC bool none_of(Mask m)
{
    return lane_bits(m) == 0u;
}
STATIC uint count_of(Mask m)
{
    return popcount(lane_bits(m));
}
STATIC uint lowest_bit(uint bits)
{
    return 31u - clz(bits & (0u - bits));
}

/* The values of the lanes, one by one. Loops over lanes stand only here and where memory is read or written. */
typedef union FloatLanes {
    Float lanes;
    real lane[LANES];
} FloatLanes;
typedef union UintLanes {
    Uint lanes;
    uint lane[LANES];
} UintLanes;

/* Read base[index] for the active lanes, base[0] for the others: base holds at least one element. */
STATIC Float gather_real(global const real* base, Uint index, Mask active)
{
    UintLanes i;
    i.lanes = active ? index : (Uint)(0u);
    FloatLanes value;
#pragma unroll
    for (int lane = 0; lane < LANES; lane++) value.lane[lane] = base[i.lane[lane]];
    return value.lanes;
}
STATIC Uint gather_uint(global const uint* base, Uint index, Mask active)
{
    UintLanes i, value;
    i.lanes = active ? index : (Uint)(0u);
#pragma unroll
    for (int lane = 0; lane < LANES; lane++) value.lane[lane] = base[i.lane[lane]];
    return value.lanes;
}
/* Read the real4 that an expression of `i` names, for i = index of each active lane (0 for the others), e.g.
 * gather_real4(primitives[i].a, hit.primitive, active, &x, &y, &z, &w). */
#define gather_real4(element, index, active, out0, out1, out2, out3)                                                   \
    do {                                                                                                               \
        UintLanes index_;                                                                                              \
        FloatLanes x_, y_, z_, w_;                                                                                     \
        index_.lanes = (active) ? (index) : (Uint)(0u);                                                                \
        _Pragma("unroll") for (int lane_ = 0; lane_ < LANES; lane_++)                                                  \
        {                                                                                                              \
            uint i = index_.lane[lane_];                                                                               \
            real4 value_ = (element);                                                                                  \
            x_.lane[lane_] = value_.x;                                                                                 \
            y_.lane[lane_] = value_.y;                                                                                 \
            z_.lane[lane_] = value_.z;                                                                                 \
            w_.lane[lane_] = value_.w;                                                                                 \
        }                                                                                                              \
        *(out0) = x_.lanes;                                                                                            \
        *(out1) = y_.lanes;                                                                                            \
        *(out2) = z_.lanes;                                                                                            \
        *(out3) = w_.lanes;                                                                                            \
    } while (0)

/* Read four uint members of the struct that an expression of `i` names. */
#define gather_members(element, index, active, m0, out0, m1, out1, m2, out2, m3, out3)                                 \
    do {                                                                                                               \
        UintLanes index_, x_, y_, z_, w_;                                                                              \
        index_.lanes = (active) ? (index) : (Uint)(0u);                                                                \
        _Pragma("unroll") for (int lane_ = 0; lane_ < LANES; lane_++)                                                  \
        {                                                                                                              \
            uint i = index_.lane[lane_];                                                                               \
            x_.lane[lane_] = (element).m0;                                                                             \
            y_.lane[lane_] = (element).m1;                                                                             \
            z_.lane[lane_] = (element).m2;                                                                             \
            w_.lane[lane_] = (element).m3;                                                                             \
        }                                                                                                              \
        *(out0) = x_.lanes;                                                                                            \
        *(out1) = y_.lanes;                                                                                            \
        *(out2) = z_.lanes;                                                                                            \
        *(out3) = w_.lanes;                                                                                            \
    } while (0)

/* Write a real4 to the place that an expression of `i` names, for the lanes of the mask. */
#define scatter_real4(element, index, mask, in0, in1, in2, in3)                                                        \
    do {                                                                                                               \
        UintLanes index_;                                                                                              \
        FloatLanes x_, y_, z_, w_;                                                                                     \
        index_.lanes = (index);                                                                                        \
        x_.lanes = (in0);                                                                                              \
        y_.lanes = (in1);                                                                                              \
        z_.lanes = (in2);                                                                                              \
        w_.lanes = (in3);                                                                                              \
        for (uint bits_ = lane_bits(mask); bits_ != 0u; bits_ &= bits_ - 1u) {                                         \
            uint lane_ = lowest_bit(bits_);                                                                            \
            uint i = index_.lane[lane_];                                                                               \
            (element) = (real4)(x_.lane[lane_], y_.lane[lane_], z_.lane[lane_], w_.lane[lane_]);                       \
        }                                                                                                              \
    } while (0)
