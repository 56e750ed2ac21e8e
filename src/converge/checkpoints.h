// When a study looks at a render: at numbers of samples or at times that grow by a factor.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace etendue
{
struct Checkpoints {
    enum class Axis { samples, seconds };

    Axis axis = Axis::samples;
    double first = 1.0, last = 1024.0, factor = 2.0;

    // first, first * factor, ... up to last; of samples the whole numbers nearest to them, each once.
    std::vector<double> values() const;
    // "spp:1:1024:x2".
    std::string text() const;
};

// From spp:FIRST:LAST:xFACTOR or time:FIRST:LAST:xFACTOR. Throws UsageError.
Checkpoints parse_checkpoints(const std::string& text);

// Which checkpoints have been passed. Passes of a render end where they must, so that a checkpoint is taken at the
// first end at or after it, and one end may serve several.
class CheckpointClock
{
public:
    explicit CheckpointClock(const Checkpoints& checkpoints) : axis_(checkpoints.axis), values_(checkpoints.values()) {}

    // Whether this is the first end at or after some checkpoint.
    bool due(std::uint64_t samples, double seconds);
    bool finished() const { return next_ == values_.size(); }
    // The number of the last one passed, from 0.
    std::size_t passed() const { return next_ - 1; }

private:
    Checkpoints::Axis axis_;
    std::vector<double> values_;
    std::size_t next_ = 0;
};
} // namespace etendue
