// JSON whose every value knows its file, line, column and path, read with jsoncpp; and -D path=value on top of it.
#pragma once

#include "util/error.h"
#include "util/json_text.h"

#include <json/value.h>

#include <cstdint>
#include <string>
#include <vector>

namespace etendue::json
{
class Document;

// A view of one value; cheap to copy, valid as long as its Document.
class Value
{
public:
    bool is_object() const { return value_->isObject(); }
    bool is_array() const { return value_->isArray(); }
    bool is_string() const { return value_->isString(); }
    bool is_boolean() const { return value_->isBool(); }
    bool is_number() const { return value_->isNumeric(); }

    bool has(const std::string& key) const { return is_object() && value_->isMember(key); }
    std::vector<std::string> keys() const; // of an object, sorted; else none
    std::size_t size() const { return is_array() || is_object() ? value_->size() : 0; }
    Value operator[](const std::string& key) const; // of an object that has it
    Value operator[](std::size_t index) const;      // of an array, index < size()

    std::string as_string() const { return value_->asString(); }
    bool as_boolean() const { return value_->asBool(); }
    double as_number() const { return value_->asDouble(); }
    const Json::Value& raw() const { return *value_; }

    // "/materials/2/roughness", "" for the root.
    const std::string& pointer() const { return pointer_; }
    SourceLocation location() const;
    // Of the key, where it can be found in the text; else of its value.
    SourceLocation key_location(const std::string& key) const;
    // What is there, for messages: numbers, strings, true, false and null as written, "a list of 3 values", "an
    // object".
    std::string description() const;
    [[noreturn]] void fail(const std::string& message) const { throw SceneError(location(), message); }

private:
    friend class Document;
    Value(const Document& document, const Json::Value& value, std::string pointer)
        : document_(&document), value_(&value), pointer_(std::move(pointer))
    {
    }

    const Document* document_;
    const Json::Value* value_;
    std::string pointer_;
};

// A parsed file with its overrides applied.
class Document
{
public:
    // `file` is what messages call it. An override is path=value: the path has dots (film.size, shapes.0.material) or
    // is a JSON pointer (/film/size); the value is JSON, or a string where it is not. Keys that do not exist are added;
    // a name on the way that stands for {"type": name} becomes that object. Throws SceneError for what is not JSON, for
    // keys that are there twice, and for a path that leads nowhere; UsageError for an override without "=" or not in
    // UTF-8.
    Document(std::string text, const std::string& file, const std::vector<std::string>& overrides = {});
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    Value root() const { return {*this, root_, ""}; }
    // The document as one line without comments, keys sorted: equal for equal content.
    std::string canonical() const;

private:
    friend class Value;

    // One -D: what it put where.
    struct Override {
        Text text;           // "-D path=value"; the offsets of what it made are places in it
        std::string pointer; // the highest value that it made
    };
    void apply_override(const std::string& option);
    const Override* override_of(const std::string& pointer) const;
    SourceLocation location(const std::string& pointer, std::ptrdiff_t offset) const;
    const Text& source(const std::string& pointer) const;

    Text text_;
    Json::Value root_;
    std::vector<Override> overrides_;
};

// A key as a part of a JSON pointer (RFC 6901): ~ and / escaped.
std::string escape_key(const std::string& key);
} // namespace etendue::json
