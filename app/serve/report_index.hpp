// What a folder of reports holds, as a page: its documents and what each says of itself.
//
// Units : none
// Errors: none; a file that cannot be read is not listed
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frustum::app {

struct ListedReport {
  std::string page{};     // path below the folder, with /
  std::string title{};    // of the document beside it, or its file's name
  std::string kind{};     // "result", "motion", "study": of the document's schema; empty: unknown
  std::string verdict{};  // "pass", "fail", "uncertain"; empty: none is stated
};

// Pages below the folder, by path; hidden files and folders and links that lead out are left aside.
[[nodiscard]] std::vector<ListedReport> reports_in(const std::filesystem::path& folder);
[[nodiscard]] std::string index_html(const std::string& title,
                                     const std::vector<ListedReport>& reports);

}  // namespace frustum::app
