/* What a driver does with floating point: each result is compared with the host's, bit by bit. Everything is loaded,
 * so that no compiler knows it beforehand. */
/* As in math/lanes.h, which this program does not need. */
#define STATIC static inline __attribute__((always_inline))

#define IS_NAN_COMPARED 1u
#define IS_NAN_FUNCTION 2u
#define IS_NAN_BITS 4u
#define IS_INFINITE 8u

/* The sum of all numbers with the error carried along (Kahan 1965): what is left of it when a compiler reorders sums
 * is the naive sum. */
STATIC float compensated_sum(global const float* a, uint count)
{
    float sum = 0.0, carried = 0.0;
    for (uint i = 0u; i < count; i++) {
        float next = a[i] - carried;
        float total = sum + next;
        carried = (total - sum) - next;
        sum = total;
    }
    return sum;
}

/* Numbers a, b, c, d and special ones with a factor each; ten results of each item, by kind. */
kernel void canary(uint count, global const float* a, global const float* b, global const float* c,
                   global const float* d, global const float* special, global const float* factor, global uint* results)
{
    const uint i = (uint)get_global_id(0);
    /* Round products one by one: contracted, the two differences are not opposite. */
    results[i] = as_uint(a[i] * b[i] - c[i] * d[i]);
    results[count + i] = as_uint(c[i] * d[i] - a[i] * b[i]);
    /* Recover the rounding error of a sum (Knuth). */
    float sum = a[i] + b[i], b_part = sum - a[i];
    results[2u * count + i] = as_uint((a[i] - (sum - b_part)) + (b[i] - b_part));
    /* Divide, take a root, multiply and add with one rounding. */
    results[3u * count + i] = as_uint(a[i] / b[i]);
    results[4u * count + i] = as_uint(sqrt(c[i]));
    results[5u * count + i] = as_uint(fma(a[i], b[i], -c[i]));
    /* See what is not a number, in three ways, and what is infinite. */
    float x = special[i];
    uint seen = x != x ? IS_NAN_COMPARED : 0u;
    seen |= isnan(x) ? IS_NAN_FUNCTION : 0u;
    seen |= (as_uint(x) & 0x7fffffffu) > 0x7f800000u ? IS_NAN_BITS : 0u;
    seen |= x == INFINITY || x == -INFINITY ? IS_INFINITE : 0u;
    results[6u * count + i] = seen;
    /* Keep numbers below the normal ones, and the sign of zero. */
    results[7u * count + i] = as_uint(x * factor[i]);
    results[8u * count + i] = as_uint(0.0 - x);
    /* Sum all. */
    results[9u * count + i] = i == 0u ? as_uint(compensated_sum(c, count)) : 0u;
}
