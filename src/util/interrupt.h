// Ctrl-C: the first one asks the program to finish what it has begun, the second one ends it.
#pragma once

namespace etendue
{
// While one exists, SIGINT sets the flag that interrupted() reads; a second SIGINT exits the process at once with
// code 130. The constructor clears the flag, the destructor restores what was there before. One at a time.
class InterruptGuard
{
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

private:
    void (*previous_)(int);
};

// Whether SIGINT came since the last InterruptGuard was made. Any thread may ask.
bool interrupted();
} // namespace etendue
