// How two replayed paths are compared.
#include "command/vertex_values.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace etendue;

namespace
{
// A vertex on a primitive, with everything else alike.
fp64::PathVertex vertex_on(std::uint32_t primitive, double x = 0.0, double throughput = 1.0)
{
    fp64::PathVertex v{};
    v.primitive = primitive;
    v.position = {{x, 0, 0, 0}};
    v.throughput = {{throughput, 0, 0, 1}};
    return v;
}

PathRecord path_of(std::vector<fp64::PathVertex> vertices)
{
    PathRecord record;
    record.vertex_count = static_cast<std::uint32_t>(vertices.size());
    record.vertices = std::move(vertices);
    return record;
}
} // namespace

TEST_CASE("two paths are compared vertex by vertex until they part", "[command][replay]")
{
    const PathRecord a = path_of({vertex_on(3), vertex_on(5, 0.5), vertex_on(7)});
    PathDifference d = compare_paths(a, a);
    CHECK_FALSE(d.parts_at);
    CHECK(d.largest == 0.0);

    d = compare_paths(a, path_of({vertex_on(3, 0.0, 1.0 + 1e-6), vertex_on(5, 0.5 + 1e-3), vertex_on(7)}));
    CHECK_FALSE(d.parts_at);
    CHECK(d.largest == Approx(1e-3));
    CHECK(d.vertex == 1);
    CHECK(d.quantity == "position");

    d = compare_paths(a, path_of({vertex_on(3, 0.0, 2.0), vertex_on(6, 0.9), vertex_on(7)}));
    CHECK(d.parts_at == 1u);
    CHECK(d.largest == 0.5);
    CHECK(d.vertex == 0);
    CHECK(d.quantity == "throughput");

    CHECK(compare_paths(a, path_of({vertex_on(3), vertex_on(5, 0.5)})).parts_at == 2u);
    CHECK(compare_paths(path_of({}), a).parts_at == 0u);

    // Infinite and undefined numbers agree with themselves alone.
    const double infinite = std::numeric_limits<double>::infinity();
    const PathRecord b = path_of({vertex_on(3, 0.0, infinite), vertex_on(5, NAN)});
    CHECK(compare_paths(b, b).largest == 0.0);
    CHECK(compare_paths(b, path_of({vertex_on(3), vertex_on(5, NAN)})).largest == infinite);
    CHECK(compare_paths(b, path_of({vertex_on(3, 0.0, infinite), vertex_on(5)})).largest == infinite);
}
