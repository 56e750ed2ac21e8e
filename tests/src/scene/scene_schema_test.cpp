#include "scene/scene_schema.h"
#include "util/file.h"

#include <json/reader.h>

#include <functional>
#include <memory>

using namespace etendue;

namespace
{
Json::Value parsed_schema()
{
    const std::string text = scene_schema();
    Json::Value schema;
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    REQUIRE(reader->parse(text.data(), text.data() + text.size(), &schema, nullptr));
    return schema;
}
} // namespace

TEST_CASE("scenes/scene.schema.json is what the parser's tables say", "[host]")
{
    CHECK(read_file(ETENDUE_SOURCE_DIR "/scenes/scene.schema.json") == scene_schema());
}

TEST_CASE("scenes/FORMAT.md ends with what the parser's tables say", "[host]")
{
    CHECK(read_file(ETENDUE_SOURCE_DIR "/scenes/FORMAT.md").ends_with("## Reference\n\n" + scene_reference()));
}

TEST_CASE("every reference of the schema has its definition", "[host]")
{
    const Json::Value schema = parsed_schema();
    CHECK(schema["$schema"].asString() == "https://json-schema.org/draft/2020-12/schema");
    int references = 0;
    const std::function<void(const Json::Value&)> visit = [&](const Json::Value& value) {
        if (value.isObject() && value["$ref"].isString()) {
            ++references;
            const std::string name = value["$ref"].asString().substr(std::string("#/$defs/").size());
            CHECK(schema["$defs"].isMember(name));
        }
        if (value.isObject() || value.isArray())
            for (const Json::Value& member : value) visit(member);
    };
    visit(schema);
    CHECK(references > 10);
}

TEST_CASE("the schema holds ranges, defaults, names and what is required", "[host]")
{
    const Json::Value schema = parsed_schema();
    const Json::Value& camera = schema["$defs"]["camera"]["oneOf"][0];
    CHECK(camera["properties"]["vertical_fov"]["exclusiveMaximum"].asInt() == 180);
    CHECK(camera["properties"]["vertical_fov"]["default"].asDouble() == 19.5);
    CHECK_FALSE(camera["additionalProperties"].asBool());
    const Json::Value& glass = schema["$defs"]["material"]["oneOf"][2];
    CHECK(glass["properties"]["type"]["const"].asString() == "dielectric");
    CHECK(glass["required"][0].asString() == "type");
    CHECK(glass["required"][1].asString() == "name");
    CHECK(schema["$defs"]["filter"]["oneOf"][3]["enum"].size() == 3);
}
