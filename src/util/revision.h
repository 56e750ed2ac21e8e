// Which sources the program was built from.
#pragma once

namespace etendue
{
// The commit, with "-dirty" after it when files were changed since; "unknown" outside of a repository.
extern const char* const REVISION;
} // namespace etendue
