// Ctrl-C, with nothing in the handler that the C++ standard does not allow there.
#include "util/interrupt.h"

#include "util/error.h"

#include <atomic>
#include <csignal>
#include <cstdlib>

namespace etendue
{
namespace
{
std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void handle_interrupt(int signal)
{
    // Some systems reset the handler before they call it.
    std::signal(signal, handle_interrupt);
    if (flag.exchange(true)) std::_Exit(static_cast<int>(ExitCode::interrupted));
}
} // namespace

InterruptGuard::InterruptGuard()
{
    flag = false;
    previous_ = std::signal(SIGINT, handle_interrupt);
}

InterruptGuard::~InterruptGuard()
{
    if (previous_ != SIG_ERR) std::signal(SIGINT, previous_);
}

bool interrupted()
{
    return flag;
}
} // namespace etendue
