#include "report/html/page_bundle.hpp"

#include <map>

// The assembler copies the files into the object: a megabyte of script is no work for the compiler.
// The build states the dependence on the files (report/CMakeLists.txt).
#define FRUSTUM_EMBED(name, file)   \
  asm(".pushsection .rodata\n"      \
      ".hidden " name               \
      "_begin\n"                    \
      ".hidden " name               \
      "_end\n"                      \
      ".global " name               \
      "_begin\n"                    \
      ".global " name "_end\n" name \
      "_begin:\n"                   \
      ".incbin \"" file "\"\n" name \
      "_end:\n"                     \
      ".byte 0\n"                   \
      ".popsection\n")

FRUSTUM_EMBED("frustum_page_template", FRUSTUM_PAGE_TEMPLATE);
FRUSTUM_EMBED("frustum_page_style", FRUSTUM_PAGE_STYLE);
FRUSTUM_EMBED("frustum_page_script", FRUSTUM_PAGE_SCRIPT);

extern "C" {
extern const char frustum_page_template_begin[];
extern const char frustum_page_template_end[];
extern const char frustum_page_style_begin[];
extern const char frustum_page_style_end[];
extern const char frustum_page_script_begin[];
extern const char frustum_page_script_end[];
}

namespace frustum::report {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view page_template() {
  return between(frustum_page_template_begin, frustum_page_template_end);
}

std::string_view page_style() { return between(frustum_page_style_begin, frustum_page_style_end); }

std::string_view page_script() {
  return between(frustum_page_script_begin, frustum_page_script_end);
}

std::string filled_page(std::string_view title, std::string_view body, std::string_view data,
                        std::string_view language) {
  const std::map<std::string_view, std::string_view> contents = {
      {"language", language}, {"title", title}, {"style", page_style()},
      {"body", body},         {"data", data},   {"script", page_script()}};
  // Each place of the template is filled once; what is filled in is not looked at again.
  std::string page;
  std::string_view rest = page_template();
  while (true) {
    const std::size_t open = rest.find("{{");
    const std::size_t close = open == std::string_view::npos ? open : rest.find("}}", open);
    if (close == std::string_view::npos) break;
    page += rest.substr(0, open);
    const auto content = contents.find(rest.substr(open + 2, close - open - 2));
    if (content != contents.end()) page += content->second;
    rest.remove_prefix(close + 2);
  }
  page += rest;
  return page;
}

}  // namespace frustum::report
