// A copy of the page with a probe at its top is held in frames of the wanted widths; each tells the page around them what
// it found, and that is read from Chromium's dump of the document.
#include "support/browser.h"

#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <json/json.h>

namespace etendue
{
namespace
{
constexpr int FRAME_HEIGHT = 900;

const char* const PROBE = R"(<script>
const errors = [];
addEventListener('error', e => errors.push(e.message || 'cannot load ' + (e.target.src || e.target.href)), true);
addEventListener('unhandledrejection', e => errors.push('' + e.reason));
addEventListener('securitypolicyviolation', e => errors.push('' + e.blockedURI));
const consoleError = console.error;
console.error = (...words) => { errors.push(words.join(' ')); consoleError(...words); };

function parse(color) {
    const numbers = color.match(/[\d.]+/g).map(Number);
    return {rgb: numbers.slice(0, 3), alpha: numbers.length > 3 ? numbers[3] : 1};
}
function luminance(rgb) {
    const [r, g, b] = rgb.map(c => c / 255).map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
// Opaque colour behind an element: its own or that of what holds it. A drawing's paper is its first rectangle.
function paperOf(element) {
    const svg = element.closest('svg');
    if (svg && svg.querySelector('rect')) return parse(getComputedStyle(svg.querySelector('rect')).fill).rgb;
    for (let e = element; e; e = e.parentElement) {
        const color = parse(getComputedStyle(e).backgroundColor);
        if (color.alpha === 1) return color.rgb;
    }
    return [255, 255, 255];
}
function contrastOf(element) {
    const style = getComputedStyle(element), svg = element.closest('svg');
    const a = luminance(parse(svg ? style.fill : style.color).rgb), b = luminance(paperOf(element));
    return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
}
function sizeOf(element) {
    const size = parseFloat(getComputedStyle(element).fontSize), svg = element.closest('svg');
    if (!svg) return size;
    const matrix = element.getScreenCTM();
    return size * Math.hypot(matrix.a, matrix.b);
}
function visibleTexts() {
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), texts = [];
    for (let node; node = walker.nextNode();)
        if (node.data.trim() && !node.parentElement.closest('style, script, svg > title')) texts.push(node);
    return texts;
}
addEventListener('load', () => {
    const found = {width: innerWidth, scroll_width: document.documentElement.scrollWidth, errors,
                   requests: performance.getEntriesByType('resource').map(e => e.name).filter(n => !/^data:/.test(n)),
                   images: document.images.length,
                   broken_images: [...document.images].filter(i => !i.complete || !i.naturalWidth).length,
                   figures_without_text: [...document.images].filter(i => !i.alt).length +
                       [...document.querySelectorAll('svg')].filter(s => !s.getAttribute('aria-label')).length,
                   smallest_text: 1e9, smallest_words: '', least_contrast: 1e9, least_contrast_words: ''};
    for (const text of visibleTexts()) {
        const size = sizeOf(text.parentElement), contrast = contrastOf(text.parentElement);
        if (size < found.smallest_text) [found.smallest_text, found.smallest_words] = [size, text.data.trim()];
        if (contrast < found.least_contrast)
            [found.least_contrast, found.least_contrast_words] = [contrast, text.data.trim()];
    }
    parent.postMessage(JSON.stringify(found), '*');
});
</script>)";

const char* const COLLECTOR = R"(<script>
const found = [];
addEventListener('message', e => {
    found.push(JSON.parse(e.data));
    document.getElementById('found').textContent = 'BEGIN' + btoa(unescape(encodeURIComponent(JSON.stringify(found)))) + 'END';
});
</script>
<p id="found"></p>
)";

ChildResult run_chromium(const TemporaryFolder& folder, const std::vector<std::string>& arguments, bool is_dark)
{
    std::vector<std::string> all{"--headless",
                                 "--no-sandbox",
                                 "--disable-gpu",
                                 "--disable-dev-shm-usage",
                                 "--no-first-run",
                                 "--disable-extensions",
                                 "--disable-background-networking",
                                 "--hide-scrollbars",
                                 "--virtual-time-budget=20000",
                                 "--user-data-dir=" + (folder.path() / "profile").string(),
                                 fmt::format("--blink-settings=preferredColorScheme={}", is_dark ? 0 : 1)};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ChildResult result = run_child("chromium", all, {{"HOME", folder.path().string()}});
    if (result.exit_code != 0)
        throw std::runtime_error(fmt::format("chromium ended with {}: {}", result.exit_code, result.errors));
    return result;
}

std::string frame(const std::string& page, int width, int height)
{
    return fmt::format("<iframe src=\"{}\" width=\"{}\" height=\"{}\" style=\"border:0;display:block\"></iframe>\n",
                       page, width, height);
}

// A page of Chromium's that holds frames.
std::string write_holder(const TemporaryFolder& folder, const std::string& body)
{
    const std::string path = (folder.path() / "holder.html").string();
    write_file(path, "<!DOCTYPE html><meta charset=\"utf-8\"><meta name=\"color-scheme\" content=\"light dark\">"
                     "<body style=\"margin:0\">" + body);
    return "file://" + path;
}

std::vector<std::string> strings_of(const Json::Value& json)
{
    std::vector<std::string> strings;
    for (const Json::Value& value : json) strings.push_back(value.asString());
    return strings;
}

PageView view_of(const Json::Value& json)
{
    PageView view;
    view.width = json["width"].asInt();
    view.scroll_width = json["scroll_width"].asInt();
    view.errors = strings_of(json["errors"]);
    view.requests = strings_of(json["requests"]);
    view.images = json["images"].asInt();
    view.broken_images = json["broken_images"].asInt();
    view.figures_without_text = json["figures_without_text"].asInt();
    view.smallest_text = json["smallest_text"].asDouble();
    view.smallest_words = json["smallest_words"].asString();
    view.least_contrast = json["least_contrast"].asDouble();
    view.least_contrast_words = json["least_contrast_words"].asString();
    return view;
}

std::string decode_base64(const std::string& text)
{
    static const std::string DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<unsigned>(DIGITS.find(c));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xff);
    }
    return bytes;
}

Json::Value json_in(const std::string& dump)
{
    const std::size_t begin = dump.find(">BEGIN"), end = dump.find("END<", begin);
    if (begin == std::string::npos || end == std::string::npos)
        throw std::runtime_error("chromium's dump of the page holds no findings: " + dump.substr(0, 2000));
    const std::string text = decode_base64(dump.substr(begin + 6, end - begin - 6));
    Json::Value json;
    std::string errors;
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    if (!reader->parse(text.data(), text.data() + text.size(), &json, &errors)) throw std::runtime_error(errors);
    return json;
}

std::string joined(const std::vector<std::string>& strings)
{
    return fmt::format("{}", fmt::join(strings, "; "));
}
} // namespace

std::vector<PageView> view_page(const std::string& path, const std::vector<int>& widths, bool is_dark)
{
    const TemporaryFolder folder;
    std::string page = read_file(path);
    const std::size_t head = page.find("<head>");
    if (head == std::string::npos) throw std::runtime_error(path + " has no <head>.");
    page.insert(head + 6, PROBE);
    write_file((folder.path() / "page.html").string(), page);

    std::string frames;
    for (const int width : widths) frames += frame("page.html", width, FRAME_HEIGHT);
    const std::string holder = write_holder(folder, COLLECTOR + frames);
    const ChildResult result = run_chromium(folder, {"--window-size=1400,1000", "--dump-dom", holder}, is_dark);
    std::vector<PageView> views;
    for (const Json::Value& found : json_in(result.output)) views.push_back(view_of(found));
    if (views.size() != widths.size()) throw std::runtime_error("a frame of the page has not loaded.");
    return views;
}

void check_page(const std::string& path)
{
    const std::string page = read_file(path);
    CHECK_THAT(page, Catch::StartsWith("<!DOCTYPE html>"));
    CHECK_THAT(page, Catch::Contains("<html lang=\"en\">") && Catch::Contains("name=\"viewport\""));
    for (const bool is_dark : {false, true}) {
        for (const PageView& view : view_page(path, {1280, 400}, is_dark)) {
            INFO(path << " at " << view.width << (is_dark ? " dark" : " light"));
            INFO("errors: " << joined(view.errors) << "; requests: " << joined(view.requests));
            CHECK((view.width == 1280 || view.width == 400));
            CHECK(view.scroll_width <= view.width);
            CHECK(view.errors.empty());
            CHECK(view.requests.empty());
            CHECK(view.broken_images == 0);
            CHECK(view.figures_without_text == 0);
            INFO("smallest: " << view.smallest_words << "; least contrast: " << view.least_contrast_words);
            CHECK(view.smallest_text >= 11.0);
            CHECK(view.least_contrast >= 4.5);
        }
    }
}

void photograph_page(const std::string& path, int width, int height, const std::string& png, bool is_dark)
{
    const TemporaryFolder folder;
    const std::string page = "file://" + std::filesystem::absolute(path).string();
    const std::string holder = write_holder(folder, frame(page, width, height));
    run_chromium(folder, {fmt::format("--window-size={},{}", width, height),
                          "--screenshot=" + std::filesystem::absolute(png).string(), holder},
                 is_dark);
}
} // namespace etendue
