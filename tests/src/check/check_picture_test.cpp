// Pictures that checks judge: what they say of accidents, and the estimates of a channel.
#include "check/check_picture.h"

#include "scene/scene_loader.h"
#include "support/child_process.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

using namespace etendue;
using Catch::Contains;

TEST_CASE("an accident comes with the command that shows its path", "[render][check]")
{
    // No path in a white room ever ends: it outlives the limit of its length.
    const std::string file = ETENDUE_SOURCE_DIR "/scenes/furnace/furnace.json";
    const std::vector<std::string> overrides{"integrator.max_depth=65536", "film.size=[2,1]", "sampler.spp=1",
                                             "materials.0.albedo=1"};
    CheckContext context;
    context.device = &test_devices().front();
    PictureChoice choice;
    choice.other_kernel = true;
    choice.overrides = overrides;
    const CheckPicture picture = check_picture(context, load_scene(file, overrides), choice);
    CHECK_THAT(picture.accident, Contains("2 samples counted as zero because of path_too_long"));
    const std::size_t at = picture.accident.find("etendue replay");
    REQUIRE(at != std::string::npos);

    // The shell runs it as it stands.
    const std::string command = std::string(ETENDUE_BINARY_DIR "/") + picture.accident.substr(at);
    const ChildResult result = run_child("/bin/sh", {"-c", command});
    INFO(command << "\n" << result.errors);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("path_too_long"));
}
