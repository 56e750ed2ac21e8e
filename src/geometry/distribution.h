// Discrete distributions in integers: what is sampled and what is called its probability agree exactly.
#pragma once

#include "math/shared.h"

#include <span>
#include <vector>

namespace etendue
{
struct AliasTable {
    std::vector<AliasBucket> buckets;  // a power of two of them, at least as many as entries
    std::vector<double> probabilities; // of each entry, as the integers realise it; they add up to 1
};

// An alias table (Vose 1991, "A linear algorithm for generating random numbers with a given distribution") whose
// thresholds are integers. Weights are finite and not negative; an entry of weight zero is never chosen, one of
// positive weight always can be. Without a positive weight the table is empty.
AliasTable make_alias_table(std::span<const double> weights);
} // namespace etendue
