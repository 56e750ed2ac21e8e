// Run the program, and turn an Error into one message and an exit code.
#include "command/program.h"
#include "util/error.h"

#include <exception>
#include <iostream>
#include <new>

int main(int argc, char** argv)
{
    try {
        return etendue::run_program(argc, argv);
    } catch (const etendue::Error& e) {
        std::cerr << "etendue: " << e.what() << '\n';
        return static_cast<int>(e.code());
    } catch (const std::bad_alloc&) {
        std::cerr << "etendue: This machine has not enough memory for the scene.\n";
        return static_cast<int>(etendue::ExitCode::scene);
    } catch (const std::exception& e) {
        std::cerr << "etendue: The system refused something: " << e.what() << ".\n";
        return static_cast<int>(etendue::ExitCode::device);
    }
}
