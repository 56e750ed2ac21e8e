// Nearest names by edit distance.
#include "util/suggestion.h"

#include <algorithm>
#include <numeric>

namespace etendue
{
namespace
{
constexpr std::size_t MOST_LISTED = 24;
constexpr std::size_t LONGEST_COMPARED = 64;

// Insertions, deletions and replacements that turn a into b (Wagner and Fischer 1974), one row at a time.
std::size_t edit_distance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[b.size()];
}
} // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& known)
{
    if (name.size() > LONGEST_COMPARED) return "";
    std::string nearest;
    std::size_t fewest = std::max<std::size_t>(1, name.size() / 3) + 1;
    for (const std::string& candidate : known) {
        if (candidate.size() > LONGEST_COMPARED) continue;
        const std::size_t distance = edit_distance(name, candidate);
        if (distance < fewest && distance < candidate.size()) {
            fewest = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string list_names(const std::vector<std::string>& names)
{
    if (names.empty()) return "none";
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), MOST_LISTED); ++i) text += (i ? ", " : "") + names[i];
    if (names.size() > MOST_LISTED) text += " and " + std::to_string(names.size() - MOST_LISTED) + " more";
    return text;
}

std::string unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known)
{
    const std::string nearest = nearest_name(name, known);
    std::string text = "unknown " + what + " \"" + name + "\"; ";
    if (!nearest.empty()) text += "did you mean \"" + nearest + "\"? ";
    return text + "there are: " + list_names(known);
}
} // namespace etendue
