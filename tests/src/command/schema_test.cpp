// etendue schema, as a user calls it.
#include "scene/scene_schema.h"
#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <sstream>

#include <json/json.h>

using namespace etendue;

TEST_CASE("etendue schema prints the JSON Schema that is in scenes/")
{
    const ChildResult result = run_child(ETENDUE_BINARY_DIR "/etendue", {"schema"});
    CHECK(result.exit_code == 0);
    CHECK(result.errors.empty());
    CHECK(result.output == read_file(ETENDUE_SOURCE_DIR "/scenes/scene.schema.json"));
    Json::Value schema;
    std::istringstream(result.output) >> schema;
    CHECK(schema["properties"].isMember("camera"));
}

TEST_CASE("etendue schema --reference prints the tables of the format's description")
{
    const ChildResult result = run_child(ETENDUE_BINARY_DIR "/etendue", {"schema", "--reference"});
    CHECK(result.exit_code == 0);
    CHECK(result.output == scene_reference());
    CHECK(result.output.find("max_depth") != std::string::npos);
}
