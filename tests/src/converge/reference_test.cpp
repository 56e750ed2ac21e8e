// References: analytic, from files, and rendered ones that are found again.
#include "converge/reference.h"

#include "image/image_io.h"
#include "support/child_process.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;
using Catch::Contains;

namespace
{
const std::string SCENE = ETENDUE_SOURCE_DIR "/scenes/course-box/simple_native.json";

ExpectedFact fact(ExpectedFact::Subject subject, std::vector<std::string> value)
{
    ExpectedFact result;
    result.subject = subject;
    for (std::string& text : value) result.value.push_back({std::move(text), {}});
    return result;
}

PreparedConfiguration small_box(const std::vector<std::string>& overrides = {}, const FilmSize& size = {8, 6})
{
    PreparationOptions options;
    options.scene = SCENE;
    options.overrides = overrides;
    options.size = size;
    PreparedConfiguration prepared = prepare(parse_configuration("default"), options);
    prepared.options.devices = {test_devices().front().info()};
    return prepared;
}
} // namespace

TEST_CASE("what a scene expects of its pixels is a reference without error", "[converge]")
{
    Scene scene;
    CHECK_FALSE(expected_radiance(scene, true));
    scene.expectation.emplace();
    scene.expectation->facts = {fact(ExpectedFact::Subject::warning, {}), fact(ExpectedFact::Subject::mean, {"0.5"})};
    // The mean alone says nothing of a pixel, unless somebody says that it does.
    CHECK_FALSE(expected_radiance(scene, false));
    CHECK(expected_radiance(scene, true) == Vec3(0.5));
    scene.expectation->facts.push_back(fact(ExpectedFact::Subject::pixels, {"1", "2.5", "3e-1"}));
    CHECK(expected_radiance(scene, false) == Vec3(1, 2.5, 0.3));
    scene.expectation->where = {{"a", {"1 / 2", {}}}};
    scene.expectation->facts = {fact(ExpectedFact::Subject::pixels, {"1 / (1 - a)"})};
    CHECK(expected_radiance(scene, false) == Vec3(2.0));
    // A bound, or one of two values, is not the radiance of a pixel.
    scene.expectation->facts.front().other_value = FormulaText{"1", {}};
    CHECK_FALSE(expected_radiance(scene, false));

    const Reference reference = analytic_reference(Vec3(1, 2, 3), 3, 2, "known");
    CHECK(reference.mean == Pixels(6, Vec3(1, 2, 3)));
    CHECK(reference.floor == 0.0);
}

TEST_CASE("a file is a reference with the error that it says it has", "[converge]")
{
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "reference.exr").string();
    Image image = image_of(Pixels(6, Vec3(0.5)), Pixels(6, Vec3(0.25)), 3, 2);
    image.metadata["etendue:seed"] = "3";
    write_image(image, path);
    const Reference reference = file_reference(path, {3, 2}, 4, 8);
    CHECK(reference.kind == Reference::Kind::file);
    CHECK(reference.mean == Pixels(6, Vec3(0.5)));
    CHECK(reference.floor == 0.25);
    CHECK(reference.warnings.empty());
    CHECK_THROWS_WITH(file_reference(path, {2, 3}, 4, 8), Contains("has 3x2 pixels, the study 2x3"));
    CHECK_THROWS_WITH(file_reference(path, {3, 2}, 1, 3), Contains("rendered with seed 3, which the study uses too"));

    // The mean over the seeds of a study shares theirs.
    image.metadata = {{"etendue:seeds", "11 12 13"}};
    write_image(image, path);
    CHECK_NOTHROW(file_reference(path, {3, 2}, 1, 8));
    CHECK_THROWS_WITH(file_reference(path, {3, 2}, 13, 8), Contains("rendered with seed 13"));

    write_image(image_of(Pixels(6, Vec3(0.5)), {}, 3, 2), path);
    const Reference bare = file_reference(path, {3, 2}, 1, 8);
    CHECK(bare.floor == 0.0);
    REQUIRE(bare.warnings.size() == 1);
    CHECK_THAT(bare.warnings[0], Contains("its own error is taken for none"));
    CHECK_FALSE(bare.knows_error);

    // What is not finite is no reference.
    Pixels holed(6, Vec3(0.5));
    holed[4].y = std::nan("");
    write_image(image_of(holed, Pixels(6, Vec3(0.25)), 3, 2), path);
    CHECK_THROWS_WITH(file_reference(path, {3, 2}, 1, 8), Contains("its value at pixel 1,1 is nan"));
    write_image(image_of(Pixels(6, Vec3(0.5)), Pixels(6, Vec3(INFINITY)), 3, 2), path);
    CHECK_THROWS_WITH(file_reference(path, {3, 2}, 1, 8), Contains("its standard error at pixel 0,0 is inf"));
}

TEST_CASE("the reference takes an estimator that nobody uses", "[converge]")
{
    using enum IntegratorType;
    CHECK(reference_integrator({path}) == light);
    CHECK(reference_integrator({light}) == path);
    CHECK(reference_integrator({light, path}) == bsdf);
    CHECK(reference_integrator({hemisphere, bsdf, light, path}) == light);
}

TEST_CASE("pictures that converge to the same have the same key", "[converge]")
{
    const std::string key = picture_key(small_box());
    CHECK(picture_key(small_box(
              {"integrator.type=bsdf", "sampler.seed=5", "accelerator=lbvh", "integrator.roulette=constant"})) == key);
    CHECK(picture_key(small_box({"integrator.max_depth=2"})) != key);
    CHECK(picture_key(small_box({"materials.0.albedo=0.25"})) != key);
    CHECK(picture_key(small_box({"camera.vertical_fov=20"})) != key);
    CHECK(picture_key(small_box({}, {8, 8})) != key);
    CHECK(picture_key(small_box({"film.filter=tent"})) != key);
}

TEST_CASE("large pictures are made smaller with their aspect", "[converge]")
{
    FilmDescription film;
    film.width = 640;
    film.height = 320;
    CHECK(limited_size(film, 64).width == 64);
    CHECK(limited_size(film, 64).height == 32);
    film.height = 1;
    CHECK(limited_size(film, 64).height == 1);
    CHECK(limited_size(film, 1000).width == 640);
}

TEST_CASE("a rendered reference has the error that its replicates show, and is found again", "[converge]")
{
    const TemporaryFolder folder;
    const PreparedConfiguration prepared = small_box();
    IndependentOptions options;
    options.samples = 1024;
    options.folder = folder.path() / "references";
    const Reference reference = independent_reference(prepared, options).value();
    CHECK(reference.samples == 1024);
    CHECK_FALSE(reference.from_cache);
    CHECK(reference.mean.size() == 48);
    CHECK(reference.floor > 0.0);
    CHECK(reference.degrees == 1020.0);
    // Replicates and films estimate the same variance; heavy tails make it vary.
    CHECK(reference.replicate_ratio > 0.2);
    CHECK(reference.replicate_ratio < 5.0);
    CHECK(reference.warnings.empty());

    const Reference again = independent_reference(prepared, options).value();
    CHECK(again.from_cache);
    CHECK(again.samples == 1024);
    CHECK(again.floor == reference.floor);
    CHECK(again.mean[7].x == Approx(reference.mean[7].x));
    CHECK(again.variance[7].x == Approx(reference.variance[7].x));

    // Whether there is nothing that would do, or nobody looks: rendered, and the time's end is told.
    options.folder.clear();
    options.samples = std::uint64_t{1} << 40;
    options.seconds = 0.2;
    const Reference more = independent_reference(prepared, options).value();
    CHECK_FALSE(more.from_cache);
    REQUIRE(more.warnings.size() == 1);
    CHECK_THAT(more.warnings[0], Contains("its time ended"));

    options.stop = [] { return true; };
    options.seconds = 1000.0;
    CHECK_FALSE(independent_reference(prepared, options));
}
