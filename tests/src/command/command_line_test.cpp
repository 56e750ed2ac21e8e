// The command line as a shell takes it.
#include "command/command_line.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace etendue;

TEST_CASE("a command line names what was given, quoted where a shell needs it", "[command]")
{
    CLI::App app;
    CLI::App* command = app.add_subcommand("draw");
    std::string scene;
    std::vector<std::string> outputs;
    int samples = 1;
    bool quiet = false;
    command->add_option("SCENE", scene);
    command->add_option("-o,--output", outputs)->allow_extra_args(false);
    command->add_option("--spp", samples);
    command->add_flag("--quiet", quiet);
    app.parse("draw 'my room.json' --spp 4 -o a.png -o b.exr");
    REQUIRE(command->parsed());
    const std::string line = command_line(*command);
    CHECK(line.substr(0, 34) == "etendue draw 'my room.json' --outp");
    CHECK(line.find(" --output a.png --output b.exr") != std::string::npos);
    CHECK(line.find(" --spp 4") != std::string::npos);
    CHECK(line.find("--quiet") == std::string::npos);
}

TEST_CASE("quotes within a word stay what they are", "[command]")
{
    CLI::App app;
    CLI::App* command = app.add_subcommand("draw");
    std::string scene;
    bool quiet = false;
    command->add_option("SCENE", scene);
    command->add_flag("--quiet", quiet);
    std::vector<std::string> words{"--quiet", "it's.json", "draw"}; // from the last to the first
    app.parse(words);
    CHECK(command_line(*command) == "etendue draw 'it'\\''s.json' --quiet");
}
