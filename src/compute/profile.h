// How often each kernel ran on each device in this process: the proof that something ran at all.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace etendue
{
// device name -> kernel name -> launches. Thread-safe.
void count_launch(const std::string& device, const std::string& kernel);
std::map<std::string, std::map<std::string, std::uint64_t>> launches();
} // namespace etendue
