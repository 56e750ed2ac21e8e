// One fact of an "expect" block with its formulas worked out, and what a picture says of it.
#pragma once

#include "check/check_picture.h"
#include "scene/formula.h"
#include "scene/scene.h"

#include <optional>

#include <string>
#include <vector>

namespace etendue
{
struct Fact {
    ExpectedFact text;
    std::vector<double> value; // one, or three for the channels
    std::vector<double> other; // one, or none
    double tolerance = 0.0;
    std::optional<double> delta;

    std::string subject() const; // "pixels"
    Rule rule() const { return static_cast<Rule>(text.rule); }
    double value_of(int channel) const
    {
        return value.size() == 3 ? value[static_cast<std::size_t>(channel)] : value[0];
    }
    // Of these the family is made.
    std::size_t statistical_tests() const;
};

// Throws SceneError.
Fact make_fact(const ExpectedFact& text, const Formulas& formulas);

// Each fills in a result that knows its rule already.
void judge_pixels(CheckResult& result, const Fact& fact, const CheckPicture& picture);
void judge_mean(CheckResult& result, const Fact& fact, const CheckPicture& picture, const CheckContext& context);
void judge_moment(CheckResult& result, const Fact& fact, const CheckPicture& picture);
void judge_rays(CheckResult& result, const Fact& fact, const CheckPicture& picture);
void judge_same(CheckResult& result, const Fact& fact, const CheckPicture& picture, const CheckPicture& other,
                const CheckContext& context);
// Whether one of the messages contains the fact's text.
void judge_message(CheckResult& result, const Fact& fact, const std::vector<std::string>& messages);
} // namespace etendue
