// Ctrl-C, by raising SIGINT in this process and in a child.
#include "util/interrupt.h"

#include <catch2/catch.hpp>
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

using namespace etendue;

namespace
{
volatile std::sig_atomic_t outer_calls = 0;
void count_outer(int)
{
    outer_calls = outer_calls + 1;
}
} // namespace

TEST_CASE("one interrupt sets the flag, and a new guard clears it")
{
    const InterruptGuard guard;
    CHECK_FALSE(interrupted());
    std::raise(SIGINT);
    CHECK(interrupted());
    const InterruptGuard next;
    CHECK_FALSE(interrupted());
}

TEST_CASE("the handler that was there before the guard is there after it")
{
    void (*original)(int) = std::signal(SIGINT, count_outer);
    outer_calls = 0;
    {
        const InterruptGuard guard;
        std::raise(SIGINT);
        CHECK(outer_calls == 0);
    }
    std::raise(SIGINT);
    CHECK(outer_calls == 1);
    std::signal(SIGINT, original);
}

TEST_CASE("a second interrupt ends the process at once with code 130")
{
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const InterruptGuard guard;
        std::raise(SIGINT);
        if (!interrupted()) _exit(1);
        std::raise(SIGINT);
        _exit(2);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
}
