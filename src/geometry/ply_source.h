// The numbers of a PLY file one by one, from text or from bytes: two classes with one interface.
//
// begin_element, then real or integer for each number that its properties declare, then end_element. What does not fit
// throws FileError naming file and line (text) or byte and element (binary).
#pragma once

#include "geometry/ply_header.h"
#include "geometry/text_scanner.h"
#include "util/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace etendue
{
// Elements as lines of words.
class TextSource
{
public:
    TextSource(const PlyHeader& header, const std::string& file) : scanner_(header.body, header.lines), file_(file) {}

    std::size_t remaining() const { return scanner_.rest().size() + 1; }

    void begin_element(const PlyElement& element, std::uint64_t index)
    {
        for (word_ = {}; word_.empty(); word_ = scanner_.next_word())
            if (!scanner_.next_line())
                fail(fmt::format("the file ends before {} {} of {}.", element.name, index, element.count));
    }

    void end_element()
    {
        if (!word_.empty()) fail(fmt::format("expected the end of the line, found {}.", quote(word_)));
    }

    double real(PlyType)
    {
        const auto value = parse_real(word_);
        if (!value) fail(fmt::format("expected a number with a decimal point, found {}.", found()));
        word_ = scanner_.next_word();
        return *value;
    }

    std::int64_t integer(PlyType)
    {
        const auto value = parse_integer(word_);
        if (!value) fail(fmt::format("expected a whole number, found {}.", found()));
        word_ = scanner_.next_word();
        return *value;
    }

    void check_end()
    {
        while (scanner_.next_line())
            if (word_ = scanner_.next_word(); !word_.empty())
                fail(fmt::format("expected the end of the file, found {}; the counts in the header are too small.",
                                 quote(word_)));
    }

    [[noreturn]] void fail(const std::string& message) const
    {
        throw FileError(fmt::format("{}:{}", file_, scanner_.line_number()), message);
    }

private:
    std::string found() const { return word_.empty() ? "the end of the line" : quote(word_); }

    TextScanner scanner_;
    std::string_view word_;
    const std::string& file_;
};

// Elements as packed bytes.
class BinarySource
{
public:
    BinarySource(std::string_view all, const PlyHeader& header, const std::string& file)
        : begin_(all.data()), at_(header.body.data()), end_(at_ + header.body.size()), file_(file),
          swap_((header.encoding == PlyEncoding::binary_little_endian) != (std::endian::native == std::endian::little))
    {
    }

    std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

    void begin_element(const PlyElement& element, std::uint64_t index)
    {
        element_ = &element;
        index_ = index;
    }

    void end_element() {}

    double real(PlyType type)
    {
        switch (type) {
        case PlyType::float32:
            return read<float>();
        case PlyType::float64:
            return read<double>();
        default:
            return static_cast<double>(integer(type));
        }
    }

    std::int64_t integer(PlyType type)
    {
        switch (type) {
        case PlyType::int8:
            return read<std::int8_t>();
        case PlyType::uint8:
            return read<std::uint8_t>();
        case PlyType::int16:
            return read<std::int16_t>();
        case PlyType::uint16:
            return read<std::uint16_t>();
        case PlyType::int32:
            return read<std::int32_t>();
        default:
            return read<std::uint32_t>();
        }
    }

    void check_end()
    {
        if (std::any_of(at_, end_, [](char c) { return c != '\n' && c != '\r' && c != ' '; }))
            fail(fmt::format("{} bytes follow the last element; the counts in the header are too small.", remaining()));
    }

    [[noreturn]] void fail(const std::string& message) const
    {
        throw FileError(file_, fmt::format("byte {}: {}", at_ - begin_, message));
    }

private:
    template<class T>
    T read()
    {
        if (remaining() < sizeof(T))
            fail(fmt::format("the file ends within {} {} of {}.", element_->name, index_, element_->count));
        std::array<char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), at_, sizeof(T));
        if (swap_) std::reverse(bytes.begin(), bytes.end());
        at_ += sizeof(T);
        return std::bit_cast<T>(bytes);
    }

    const char* begin_;
    const char* at_;
    const char* end_;
    const std::string& file_;
    bool swap_;
    const PlyElement* element_ = nullptr;
    std::uint64_t index_ = 0;
};
} // namespace etendue
