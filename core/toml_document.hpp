// Strict reading of the TOML files people write: every key is typed, has a unit, and is known.
//
// A reader asks a TomlTable for its keys; what is missing, has the wrong type, unit or range is
// noted in the document with file, line and key path, and a harmless value is returned so that
// reading goes on and all mistakes are reported at once. TomlDocument::finish() adds every key that
// nobody asked for, with the nearest known one, and hands out the verdict.
//
// Units: lengths are read in mm (a bare number is mm), angles in rad (a bare number is degrees); a
// string has its own unit: "10 um", "30 urad".
// Errors: load and parse refuse what cannot be read or is not TOML; all else waits for finish().
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "core/units.hpp"

namespace frustum {

enum class Bound { any, positive, non_negative };

namespace toml_detail {
struct Node;
struct State;
}  // namespace toml_detail

class TomlTable {
 public:
  [[nodiscard]] bool has(std::string_view key) const;
  // All keys in file order; asking for them does not count as reading them.
  [[nodiscard]] std::vector<std::string> keys() const;
  // "tool.1": where this table is in the document.
  [[nodiscard]] const std::string& path() const { return path_; }

  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::string text_or(std::string_view key, std::string_view fallback) const;
  // One of `choices`; anything else is an error that lists them. Returns the index.
  [[nodiscard]] std::size_t choice(std::string_view key,
                                   const std::vector<std::string>& choices) const;
  [[nodiscard]] std::size_t choice_or(std::string_view key, const std::vector<std::string>& choices,
                                      std::size_t fallback) const;
  [[nodiscard]] double number(std::string_view key, Bound bound = Bound::any) const;
  [[nodiscard]] double number_or(std::string_view key, double fallback,
                                 Bound bound = Bound::any) const;
  [[nodiscard]] std::int64_t integer(std::string_view key, Bound bound = Bound::any) const;
  [[nodiscard]] std::int64_t integer_or(std::string_view key, std::int64_t fallback,
                                        Bound bound = Bound::any) const;
  [[nodiscard]] bool boolean_or(std::string_view key, bool fallback) const;
  [[nodiscard]] Mm length(std::string_view key, Bound bound = Bound::any) const;
  [[nodiscard]] Mm length_or(std::string_view key, Mm fallback, Bound bound = Bound::any) const;
  [[nodiscard]] Rad angle(std::string_view key, Bound bound = Bound::any) const;
  [[nodiscard]] Rad angle_or(std::string_view key, Rad fallback, Bound bound = Bound::any) const;
  // A length or an angle, whichever the text's unit says; a bare number has UnitKind::none.
  [[nodiscard]] ParsedQuantity quantity(std::string_view key) const;
  // Three numbers, as written.
  [[nodiscard]] Vec3 vector(std::string_view key) const;
  [[nodiscard]] Vec3 vector_or(std::string_view key, const Vec3& fallback) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key) const;
  // A list of lists of `width` numbers each; empty when one of them is not.
  [[nodiscard]] std::vector<std::vector<double>> rows(std::string_view key,
                                                      std::size_t width) const;
  [[nodiscard]] std::vector<std::string> texts_or(std::string_view key,
                                                  std::vector<std::string> fallback) const;

  [[nodiscard]] TomlTable table(std::string_view key) const;
  [[nodiscard]] std::optional<TomlTable> table_if(std::string_view key) const;
  // An array of tables ([[key]]); empty when absent.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key) const;
  // True when `key` holds a table (so that a key may be a value or a table).
  [[nodiscard]] bool is_table(std::string_view key) const;
  [[nodiscard]] bool is_array(std::string_view key) const;
  [[nodiscard]] bool is_number(std::string_view key) const;

  // Where the document is: what its relative paths start from.
  [[nodiscard]] std::filesystem::path folder() const;
  // A path in the file, resolved against the folder of the document.
  [[nodiscard]] std::filesystem::path file_path(std::string_view key) const;

  // Whether no error has been noted in this table so far.
  [[nodiscard]] bool is_sound() const;
  // Notes an error at a key of this table (or at the table itself when the key is absent or empty).
  void fail(std::string_view key, DiagnosticId id, std::string message,
            std::string hint = {}) const;
  void fail(std::string_view key, std::string message, std::string hint = {}) const;
  // What is wrong with the value was found elsewhere.
  void fail(std::string_view key, const Diagnostic& found) const;

 private:
  friend class TomlDocument;
  TomlTable(std::shared_ptr<toml_detail::State> state, const toml_detail::Node* node,
            std::string path);
  const toml_detail::Node* find(std::string_view key, bool required) const;
  double bounded(std::string_view key, double value, Bound bound) const;
  std::optional<ParsedQuantity> read_quantity(std::string_view key) const;
  double scaled(std::string_view key, UnitKind kind, double bare_number_scale, Bound bound) const;

  std::shared_ptr<toml_detail::State> state_;
  const toml_detail::Node* node_;  // owned by state_; null means a missing required table
  std::string path_;
};

class TomlDocument {
 public:
  [[nodiscard]] static Result<TomlDocument> load(const std::filesystem::path& file);
  // Parses text; `file` names it in diagnostics and anchors relative paths.
  [[nodiscard]] static Result<TomlDocument> parse(std::string_view text,
                                                  const std::filesystem::path& file);

  [[nodiscard]] const TomlTable& root() const { return root_; }
  [[nodiscard]] std::filesystem::path folder() const;
  [[nodiscard]] const std::filesystem::path& file() const;
  // Adds an error for every key nobody asked for; returns everything noted so far.
  [[nodiscard]] Diagnostics finish() const;

 private:
  explicit TomlDocument(TomlTable root) : root_(std::move(root)) {}
  TomlTable root_;
};

// As files hold it, in quotes: what reads back as the same text.
[[nodiscard]] std::string toml_text(std::string_view text);

}  // namespace frustum
