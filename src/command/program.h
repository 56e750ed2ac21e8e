// The command line as a whole: which command it names.
#pragma once

namespace etendue
{
// Parses the command line and runs the command that it names. The exit code of the program; throws what the command
// throws.
int run_program(int argc, char** argv);
} // namespace etendue
