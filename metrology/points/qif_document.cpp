#include "metrology/points/qif_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "metrology/points/line_words.hpp"
#include "metrology/points/qif_form.hpp"

namespace frustum::metrology {
namespace {

using pugi::xml_node;

constexpr std::string_view kBlank = " \t\r\n";

// 0.001 times 1000 is a millimetre, whatever rounding says.
double as_millimetres(double mm) {
  constexpr double kRounding = 1e-12;
  for (const double exact : {1.0, 25.4, 1000.0}) {
    if (std::abs(mm / exact - 1.0) < kRounding) return exact;
  }
  return mm;
}

// Units of length as programs name them.
struct NamedUnit {
  std::string_view name;
  double mm;
};
constexpr std::array kUnits{NamedUnit{"mm", 1.0},         NamedUnit{"millimeter", 1.0},
                            NamedUnit{"millimetre", 1.0}, NamedUnit{"inch", 25.4},
                            NamedUnit{"in", 25.4},        NamedUnit{"m", 1000.0},
                            NamedUnit{"meter", 1000.0},   NamedUnit{"metre", 1000.0}};

// Bytes that are not in ASCII say what they stand for only in UTF-8.
bool is_readable_as_utf8(std::string_view bytes, std::string_view encoding) {
  std::string name(encoding);
  std::ranges::transform(name, name.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  const bool is_ascii = std::ranges::none_of(bytes, [](char c) { return (c & 0x80) != 0; });
  return is_ascii || name.empty() || name == "UTF-8" || name == "UTF8";
}

std::string element_text(xml_node element) {
  const auto id = element.attribute("id");
  return id ? fmt::format("<{} id=\"{}\">", element.name(), id.value())
            : fmt::format("<{}>", element.name());
}

}  // namespace

Result<QifDocument> QifDocument::parse(std::string_view bytes) {
  QifDocument document;
  const auto parsed = document.document_->load_buffer(
      bytes.data(), bytes.size(), pugi::parse_default | pugi::parse_declaration);
  if (parsed.encoding == pugi::encoding_utf8) {
    document.line_starts_.push_back(0);
    for (std::size_t at = bytes.find('\n'); at != bytes.npos; at = bytes.find('\n', at + 1)) {
      document.line_starts_.push_back(at + 1);
    }
  }
  const auto fault_at = [&](std::size_t offset, const std::string& message, std::string hint) {
    Diagnostic d = error("bad-xml"_id, message, std::move(hint));
    const Place place = document.place_at(offset);
    d.line = place.line;
    d.column = place.column;
    return d;
  };
  if (!parsed) {
    const auto offset = std::clamp<std::ptrdiff_t>(parsed.offset, 0, std::ssize(bytes));
    return fault_at(static_cast<std::size_t>(offset),
                    fmt::format("no XML: {}", parsed.description()),
                    "an XML document of QIF 3.0 (ISO 23952) is expected, whole");
  }
  const std::string encoding = document.document_->first_child().attribute("encoding").value();
  const bool is_utf8 = parsed.encoding == pugi::encoding_utf8;
  if (is_utf8 && !is_readable_as_utf8(bytes, encoding)) {
    return fault_at(0, fmt::format("the document is in the encoding {}", encoding),
                    "save the document as UTF-8");
  }
  const bool is_like_ascii = is_utf8 || parsed.encoding == pugi::encoding_latin1;
  if (const auto unknown = is_like_ascii ? unknown_reference(bytes) : std::nullopt) {
    return fault_at(unknown->offset, fmt::format("{} is an entity that is not read", unknown->text),
                    "only &amp; &lt; &gt; &quot; &apos; and numbers such as &#8960; are read");
  }
  drop_prefix(document.document_->document_element());
  if (auto problem = document.take_root()) return *std::move(problem);
  if (auto problem = document.take_unit()) return *std::move(problem);
  if (auto problem = list_fault(document)) return *std::move(problem);
  return document;
}

std::optional<Diagnostic> QifDocument::take_root() {
  root_ = document_->document_element();
  if (std::string_view(root_.name()) != "QIFDocument") {
    return fault(root_, "not-qif"_id, "is no <QIFDocument>",
                 "the root element of a QIF document is expected");
  }
  for (xml_node next = root_.next_sibling(); next; next = next.next_sibling()) {
    if (next.type() != pugi::node_element) continue;
    return fault(next, "bad-xml"_id, "follows the root element",
                 "one document is expected, with one root element");
  }
  const std::string_view version = root_.attribute("versionQIF").value();
  if (version.starts_with("3.")) return std::nullopt;
  return fault(
      root_, "qif-version"_id,
      version.empty() ? "states no versionQIF" : fmt::format("is of versionQIF \"{}\"", version),
      "versionQIF=\"3.0.0\" is expected: save the document as QIF 3.0");
}

std::optional<Diagnostic> QifDocument::take_unit() {
  const xml_node unit = root_.child("FileUnits").child("PrimaryUnits").child("LinearUnit");
  // Without a conversion the unit is the SI's own.
  const xml_node factor = unit.child("UnitConversion").child("Factor");
  constexpr double kMmPerMetre = 1e3;
  const auto stated = qif_numbers(factor);
  const bool is_number = !factor || (stated && stated->size() == 1);
  const double metres = factor && is_number ? stated->front() : 1.0;
  if (!unit || !is_number || !(metres > 0.0) || !std::isfinite(metres)) {
    return fault(unit ? unit : root_, "length-unit"_id, "states no unit of length",
                 "FileUnits/PrimaryUnits/LinearUnit says how many metres a unit is");
  }
  mm_ = as_millimetres(kMmPerMetre * metres);
  constexpr double kDigits = 1e-6;
  const std::string name = qif_text(unit.child("UnitName"));
  const auto* const known = std::ranges::find(kUnits, name, &NamedUnit::name);
  if (known == kUnits.end() || std::abs(mm_ / known->mm - 1.0) < kDigits) return std::nullopt;
  return fault(factor ? factor : unit, "length-unit"_id,
               fmt::format("says that {} {} is {:g} mm", name == "inch" ? "an" : "a", name, mm_),
               fmt::format("{:g} metres are expected", known->mm / kMmPerMetre));
}

QifDocument::Place QifDocument::place_at(std::size_t offset) const {
  if (line_starts_.empty()) return {};
  const auto next = std::ranges::upper_bound(line_starts_, offset);
  const auto line = next - line_starts_.begin();
  return {static_cast<int>(line), static_cast<int>(offset - *std::prev(next)) + 1};
}

QifDocument::Place QifDocument::place_of(xml_node element) const {
  // The offset of the name, which < is before.
  const std::ptrdiff_t name = element.offset_debug();
  return name < 1 ? Place() : place_at(static_cast<std::size_t>(name) - 1);
}

Diagnostic QifDocument::fault(xml_node element, DiagnosticId id, std::string_view message,
                              std::string hint) const {
  Diagnostic d = error(id, fmt::format("{} {}", element_text(element), message), std::move(hint));
  const Place place = place_of(element);
  d.line = place.line;
  d.column = place.column;
  return d;
}

std::optional<std::vector<double>> qif_numbers(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlank);
    if (begin == text.npos) return numbers;
    const std::size_t end = std::min(text.find_first_of(kBlank, begin), text.size());
    const auto number = number_in(text.substr(begin, end - begin));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
    text.remove_prefix(end);
  }
}

std::string qif_content(xml_node element) {
  std::string content;
  for (const xml_node part : element) {
    const bool is_text = part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata;
    content += is_text ? part.value() : " ";
  }
  return content;
}

std::optional<std::vector<double>> qif_numbers(xml_node element) {
  return qif_numbers(std::string_view(qif_content(element)));
}

std::string qif_text(xml_node element) {
  const std::string text = qif_content(element);
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

}  // namespace frustum::metrology
