// The include expander.
#include "compute/kernel_source.h"

#include "math/shared.h"
#include "support/child_process.h"
#include "util/environment.h"
#include "util/error.h"
#include "util/file.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
// A folder of kernel sources that stands before the embedded ones during a test.
class SourceFolder
{
public:
    SourceFolder() : before_(environment("ETENDUE_CL_DIR"))
    {
        set_environment("ETENDUE_CL_DIR", folder_.path().string());
    }
    ~SourceFolder() { set_environment("ETENDUE_CL_DIR", before_); }
    SourceFolder(const SourceFolder&) = delete;
    SourceFolder& operator=(const SourceFolder&) = delete;

    void add(const std::string& name, const std::string& text)
    {
        std::filesystem::create_directories((folder_.path() / name).parent_path());
        write_file((folder_.path() / name).string(), text);
    }

private:
    TemporaryFolder folder_;
    std::string before_;
};

std::size_t count_of(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}
} // namespace

TEST_CASE("includes are replaced by the file with directives that keep the lines right")
{
    SourceFolder sources;
    sources.add("a/inner.h", "#pragma once\nint inner;\n");
    sources.add("a/outer.h", "int before;\n  #  include \"a/inner.h\"\nint after;\n");
    sources.add("program.cl", "#include \"a/outer.h\" /* all of it */\nkernel void k(void) {}");
    CHECK(expand_program("program.cl") == "#pragma OPENCL FP_CONTRACT OFF\n"
                                          "#line 1 \"cl/program.cl\"\n"
                                          "#line 1 \"cl/a/outer.h\"\n"
                                          "int before;\n"
                                          "#line 1 \"cl/a/inner.h\"\n"
                                          "\n"
                                          "int inner;\n"
                                          "#line 3 \"cl/a/outer.h\"\n"
                                          "int after;\n"
                                          "#line 2 \"cl/program.cl\"\n"
                                          "kernel void k(void) {}\n");
}

TEST_CASE("a file is included once, even when files include each other")
{
    SourceFolder sources;
    sources.add("a.h", "#include \"b.h\"\nint a;\n");
    sources.add("b.h", "#include \"a.h\"\nint b;\n");
    const std::string text = expand_source("test", "#include \"a.h\"\n#include \"b.h\"\n#include \"a.h\"\nint c;\n");
    CHECK(count_of(text, "int a;") == 1);
    CHECK(count_of(text, "int b;") == 1);
    CHECK(count_of(text, "#include") == 0);
    CHECK(text.ends_with("#line 2 \"test\"\n\n\nint c;\n"));
}

TEST_CASE("system includes and other directives stay as they are")
{
    CHECK(expand_source("test", "#include <x.h>\n#pragma unroll\n#define A \"b\"\n") ==
          "#pragma OPENCL FP_CONTRACT OFF\n#line 1 \"test\"\n#include <x.h>\n#pragma unroll\n#define A \"b\"\n");
}

TEST_CASE("an include of a file that does not exist names the file and who wants it")
{
    SourceFolder sources;
    sources.add("a.h", "int a;\n\n#include \"math/nowhere.h\"\n");
    CHECK_THROWS_WITH(expand_source("test", "#include \"a.h\"\n"),
                      "cl/a.h:3: there is no file cl/math/nowhere.h to include.");
    CHECK_THROWS_WITH(expand_program("nowhere.cl"), "There is no kernel source cl/nowhere.cl.");
    CHECK_THROWS_AS(expand_program("nowhere.cl"), BuildError);
}

TEST_CASE("bsdf/all.h includes the file of every bsdf in the list")
{
    const std::string text = kernel_file("bsdf/all.h");
    for (const char* name : {"diffuse", "mirror", "dielectric"})
        CHECK(count_of(text, "#include \"bsdf/" + std::string(name) + ".h\"\n") == 1);
    CHECK(count_of(text, "#include") == BSDF_COUNT);
}

TEST_CASE("a folder of sources stands before the embedded files, file by file")
{
    const std::string embedded = kernel_file("shared/limits.h");
    CHECK(embedded == read_file(ETENDUE_SOURCE_DIR "/cl/shared/limits.h"));
    SourceFolder sources;
    CHECK(kernel_file("shared/limits.h") == embedded);
    sources.add("shared/limits.h", "other\n");
    CHECK(kernel_file("shared/limits.h") == "other\n");
}
