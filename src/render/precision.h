// The structs of either precision, and the way from one to the other.
//
// The scene of the fp64 twin is that of the float kernels, its numbers rounded to float, so that both see the same.
#pragma once

#include "math/precision.h"
#include "math/shared.h"

#include <type_traits>
#include <vector>

namespace etendue
{
// The structs with reals in them, by precision; those of whole numbers alone are the same in both.
struct SingleReals {
    using Real = real;
    using Real4 = real4;
    using Settings = RenderSettings;
    using Node = BvhNode;
    using Shape = Primitive;
    using Emitter = Light;
    using Result = SampleResult;
    using ResultAov = SampleAov;
    using Block = PixelBlock;
    using BlockAov = PixelAov;
    using Vertex = PathVertex;
};
struct DoubleReals {
    using Real = fp64::real;
    using Real4 = fp64::real4;
    using Settings = fp64::RenderSettings;
    using Node = fp64::BvhNode;
    using Shape = fp64::Primitive;
    using Emitter = fp64::Light;
    using Result = fp64::SampleResult;
    using ResultAov = fp64::SampleAov;
    using Block = fp64::PixelBlock;
    using BlockAov = fp64::PixelAov;
    using Vertex = fp64::PathVertex;
};

// Exactly.
fp64::real widen(real x);
fp64::real4 widen(const real4& v);
fp64::RenderSettings widen(const RenderSettings& settings);
fp64::BvhNode widen(const BvhNode& node);
fp64::Primitive widen(const Primitive& primitive);
fp64::Light widen(const Light& light);
fp64::PixelBlock widen(const PixelBlock& block);
fp64::PixelAov widen(const PixelAov& aov);
fp64::PathVertex widen(const PathVertex& vertex);

// Rounded to float. What the sum of a block loses goes into its compensation: 48 bits of it are kept.
PixelBlock narrow(const fp64::PixelBlock& block);
PixelAov narrow(const fp64::PixelAov& aov);

template<typename T>
auto widen(const std::vector<T>& values)
{
    std::vector<decltype(widen(values.front()))> wide;
    wide.reserve(values.size());
    for (const T& value : values) wide.push_back(widen(value));
    return wide;
}
template<typename T>
auto narrow(const std::vector<T>& values)
{
    std::vector<decltype(narrow(values.front()))> rounded;
    rounded.reserve(values.size());
    for (const T& value : values) rounded.push_back(narrow(value));
    return rounded;
}

// A float struct, or a vector of them, in the precision of `Reals`.
template<typename Reals, typename T>
decltype(auto) in_reals(const T& value)
{
    if constexpr (std::is_same_v<Reals, SingleReals>)
        return (value);
    else
        return widen(value);
}
} // namespace etendue
