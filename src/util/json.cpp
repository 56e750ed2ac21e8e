// JSON values that know where they were written, on top of jsoncpp.
#include "util/json.h"

#include <fmt/format.h>
#include <json/reader.h>
#include <json/writer.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string_view>

namespace etendue::json
{
namespace
{
constexpr std::size_t LONGEST_DESCRIPTION = 40;

// Turn jsoncpp's "* Line 3, Column 4\n  Missing ..." into an error of ours.
[[noreturn]] void fail_to_parse(const Text& text, const std::string& messages)
{
    std::size_t line = 1, column = 1;
    std::sscanf(messages.c_str(), "* Line %zu, Column %zu", &line, &column);
    const std::size_t start = std::min(messages.find("\n  "), messages.size());
    std::string message = start < messages.size() ? messages.substr(start + 3) : messages;
    message = message.substr(0, message.find('\n'));
    if (message.ends_with('.')) message.pop_back();

    const std::string duplicate = "Duplicate key: '";
    if (message.starts_with(duplicate))
        message = fmt::format("the key \"{}\" is there twice in one object",
                              message.substr(duplicate.size(), message.size() - duplicate.size() - 1));
    else
        message = "this is not JSON: " + message;
    throw SceneError(text.location(text.offset(line, column)), message);
}

Json::Value parse(const Text& text)
{
    text.check();
    Json::CharReaderBuilder builder;
    builder["collectComments"] = false;
    builder["allowTrailingCommas"] = false;
    builder["rejectDupKeys"] = true;
    builder["failIfExtra"] = true;
    builder["skipBom"] = true;
    builder["stackLimit"] = static_cast<Json::UInt64>(2 * MAX_DEPTH);
    const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
    const std::string& s = text.string();
    Json::Value root;
    std::string messages;
    try {
        if (!reader->parse(s.data(), s.data() + s.size(), &root, &messages)) fail_to_parse(text, messages);
    } catch (const Json::Exception& e) {
        throw SceneError(text.file() + ": this is not JSON: " + e.what());
    }
    return root;
}

std::vector<std::string> split_path(const std::string& path)
{
    const bool is_pointer = path.starts_with('/');
    const char separator = is_pointer ? '/' : '.';
    std::vector<std::string> keys(1);
    for (std::size_t i = is_pointer ? 1 : 0; i < path.size(); ++i) {
        if (path[i] == separator) {
            keys.emplace_back();
        } else if (is_pointer && path[i] == '~' && i + 1 < path.size() && (path[i + 1] == '0' || path[i + 1] == '1')) {
            keys.back() += path[++i] == '0' ? '~' : '/';
        } else {
            keys.back() += path[i];
        }
    }
    return keys;
}

// Objects and lists in each other; 0 for a plain value.
std::size_t depth(const Json::Value& value)
{
    if (!value.isObject() && !value.isArray()) return 0;
    std::size_t deepest = 0;
    for (const Json::Value& element : value) deepest = std::max(deepest, depth(element));
    return deepest + 1;
}

bool is_index(const std::string& key)
{
    return !key.empty() && key.size() < 10 && key.find_first_not_of("0123456789") == std::string::npos;
}

// Text that can only be meant as JSON, or is JSON.
bool looks_like_json(const std::string& value)
{
    if (value.find_first_of("[{\"") == value.find_first_not_of(" \t")) return true;
    try {
        Text(value, "").check();
        return true;
    } catch (const SceneError&) {
        return false;
    }
}
} // namespace

std::string escape_key(const std::string& key)
{
    std::string escaped;
    for (const char c : key) {
        if (c == '~')
            escaped += "~0";
        else if (c == '/')
            escaped += "~1";
        else
            escaped += c;
    }
    return escaped;
}

std::vector<std::string> Value::keys() const
{
    return is_object() ? value_->getMemberNames() : std::vector<std::string>{};
}

Value Value::operator[](const std::string& key) const
{
    return {*document_, (*value_)[key], pointer_ + "/" + escape_key(key)};
}

Value Value::operator[](std::size_t index) const
{
    return {*document_, (*value_)[static_cast<Json::ArrayIndex>(index)], pointer_ + "/" + std::to_string(index)};
}

SourceLocation Value::location() const
{
    return document_->location(pointer_, value_->getOffsetStart());
}

SourceLocation Value::key_location(const std::string& key) const
{
    const Value value = (*this)[key];
    const std::string& text = document_->source(value.pointer_).string();

    // Step back from the value over space and colon to the quoted key.
    const std::string quoted = "\"" + key + "\"";
    std::size_t end = static_cast<std::size_t>(value.value_->getOffsetStart());
    if (end > text.size()) return value.location();
    while (end > 0 && std::string_view(" \t\r\n:").find(text[end - 1]) != std::string_view::npos) --end;
    if (end < quoted.size() || text.compare(end - quoted.size(), quoted.size(), quoted) != 0) return value.location();
    return document_->location(value.pointer_, static_cast<std::ptrdiff_t>(end - quoted.size()));
}

std::string Value::description() const
{
    if (is_object()) return "an object";
    if (is_array()) return fmt::format("a list of {} value{}", size(), size() == 1 ? "" : "s");
    const std::string& text = document_->source(pointer_).string();
    const std::size_t start = std::min(static_cast<std::size_t>(value_->getOffsetStart()), text.size());
    const std::string written = text.substr(start, static_cast<std::size_t>(value_->getOffsetLimit()) - start);
    const std::string shown = is_string() && !written.starts_with('"') ? "\"" + as_string() + "\"" : written;
    return shown.size() <= LONGEST_DESCRIPTION ? shown : shown.substr(0, LONGEST_DESCRIPTION) + "...";
}

Document::Document(std::string text, const std::string& file, const std::vector<std::string>& overrides)
    : text_(std::move(text), file), root_(parse(text_))
{
    for (const std::string& option : overrides) apply_override(option);
}

void Document::apply_override(const std::string& option)
{
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError(fmt::format("-D {}: an override is written path=value, e.g. film.size=[64,64].", option));
    if (!is_utf8(option)) throw UsageError(fmt::format("-D {}: this option is not UTF-8.", option));
    const std::size_t value_start = equals + 4;
    Override made{Text("-D " + option, "command line"), ""};
    const auto fail = [&](std::size_t offset, const std::string& message) {
        SourceLocation where = made.text.location(offset);
        where.line = 0;
        throw SceneError(where, message);
    };

    // Read the value where it stands in the option, so that its offsets are places there.
    const std::string value_text = option.substr(equals + 1);
    Json::Value value(value_text);
    value.setOffsetStart(static_cast<std::ptrdiff_t>(value_start));
    value.setOffsetLimit(static_cast<std::ptrdiff_t>(value_start + value_text.size()));
    if (looks_like_json(value_text)) {
        try {
            value = parse(Text(std::string(value_start, ' ') + value_text, "command line"));
        } catch (const SceneError&) {
            fail(value_start, "the value is neither JSON nor a plain name");
        }
    }

    // Hold the depth against the limit of files.
    const std::vector<std::string> path = split_path(option.substr(0, equals));
    if (path.size() + depth(value) > MAX_DEPTH)
        fail(3, fmt::format("path and value are nested more than {} deep", MAX_DEPTH));

    // Walk down, adding what is missing.
    Json::Value* place = &root_;
    std::string pointer;
    for (const std::string& key : path) {
        const std::string parent = pointer.empty() ? "the scene" : pointer;
        if (place->isString()) {
            Json::Value object(Json::objectValue);
            object.setOffsetStart(place->getOffsetStart());
            object.setOffsetLimit(place->getOffsetLimit());
            object["type"] = *place;
            *place = object;
        }
        pointer += "/" + escape_key(key);
        if (place->isArray()) {
            if (!is_index(key) || std::stoul(key) >= place->size())
                fail(3, place->empty() ? fmt::format("{} is an empty list", parent)
                                       : fmt::format("{} is a list; its elements are 0 to {}, not \"{}\"", parent,
                                                     place->size() - 1, key));
            place = &(*place)[static_cast<Json::ArrayIndex>(std::stoul(key))];
        } else if (place->isObject() || place->isNull()) {
            if (made.pointer.empty() && !place->isMember(key)) made.pointer = pointer;
            place = &(*place)[key];
        } else {
            fail(3, fmt::format("{} is neither an object nor a list, so it has no \"{}\"", parent, key));
        }
    }
    if (made.pointer.empty()) made.pointer = pointer;
    *place = value;
    overrides_.push_back(std::move(made));
}

const Document::Override* Document::override_of(const std::string& pointer) const
{
    for (auto o = overrides_.rbegin(); o != overrides_.rend(); ++o) {
        const bool below = pointer.starts_with(o->pointer) &&
                           (pointer.size() == o->pointer.size() || pointer[o->pointer.size()] == '/');
        if (below) return &*o;
    }
    return nullptr;
}

const Text& Document::source(const std::string& pointer) const
{
    const Override* o = override_of(pointer);
    return o ? o->text : text_;
}

SourceLocation Document::location(const std::string& pointer, std::ptrdiff_t offset) const
{
    const Text& text = source(pointer);
    SourceLocation where = text.location(static_cast<std::size_t>(offset));
    if (&text != &text_) where.line = 0;
    where.pointer = pointer;
    return where;
}

std::string Document::canonical() const
{
    Json::StreamWriterBuilder builder;
    builder["indentation"] = "";
    builder["precision"] = 17;
    return Json::writeString(builder, root_);
}
} // namespace etendue::json
