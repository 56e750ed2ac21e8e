// What to say about a name that nobody knows.
#pragma once

#include <string>
#include <vector>

namespace etendue
{
// 'unknown bsdf "glas"; did you mean "glass"? there are: diffuse, glass, mirror'. No suggestion where nothing is near,
// and at most two dozen names are listed.
std::string unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known);

// The known name with the fewest edits to `name` (Levenshtein distance), or "" where none is near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

// "a, b, c", at most two dozen, "and 5 more".
std::string list_names(const std::vector<std::string>& names);
} // namespace etendue
