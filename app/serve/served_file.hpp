// From the path of a request to a file below a folder, and to nothing else.
//
// Units : none
// Errors: none; nothing for what is no file there: .., absolute and hidden names, other separators,
//         control characters, links that lead out
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace frustum::app {

// `path`: decoded, with / at its beginning.
[[nodiscard]] std::optional<std::filesystem::path> served_file(const std::filesystem::path& folder,
                                                               std::string_view path);
// A name below the folder as the path of a link: what has a meaning in addresses is encoded.
[[nodiscard]] std::string url_of(std::string_view name);
// By its extension; of an unknown one bytes to be saved.
[[nodiscard]] std::string_view content_type(const std::filesystem::path& file);
// The name and port that a browser has to ask for; what is asked by another name is refused, so
// that no page of another site reads reports under a name of its own.
[[nodiscard]] bool is_own_host(std::string_view host, int port);

}  // namespace frustum::app
