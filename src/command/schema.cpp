// `etendue schema`.
#include "command/schema.h"

#include "scene/scene_schema.h"
#include "util/error.h"

#include <iostream>
#include <memory>

namespace etendue
{
void register_schema(CLI::App& app, std::function<int()>& action)
{
    CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of the native scene format");
    command->footer(
        "The same text is in scenes/scene.schema.json. An editor that knows JSON Schema completes and checks\n"
        "scenes with it.");
    const auto reference = std::make_shared<bool>(false);
    command->add_flag("--reference", *reference, "Print the tables of scenes/FORMAT.md instead");
    command->callback([reference, &action] {
        action = [reference] {
            std::cout << (*reference ? scene_reference() : scene_schema());
            return static_cast<int>(ExitCode::success);
        };
    });
}
} // namespace etendue
