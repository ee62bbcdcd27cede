#include "metrology/points/qif_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "core/counted.hpp"
#include "metrology/points/qif_document.hpp"

namespace frustum::metrology {
namespace {

using pugi::xml_node;

// Below the root: what is read.
constexpr std::array<const char*, 5> kRead{"DatumDefinitions", "DatumReferenceFrames", "Features",
                                           "Characteristics", "Results"};
// Their elements are referred to.
constexpr std::array<std::string_view, 10> kReferred{
    "DatumDefinitions",    "DatumReferenceFrames",   "FeatureDefinitions",
    "FeatureNominals",     "FeatureItems",           "CharacteristicDefinitions",
    "CharacteristicItems", "CharacteristicNominals", "MeasuredPointSets",
    "MeasuredFeatures"};
// Others whose elements are counted; n of yet others counts only some of them, or numbers.
constexpr std::array<std::string_view, 5> kCounted{"Attributes", "Datums", "FeatureItemIds",
                                                   "FeatureNominalIds", "PointList"};

// Without blanks before and after, as numbers of XML Schema are read.
std::optional<std::size_t> whole_number(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == text.npos) return std::nullopt;
  text = text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin);
  std::size_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, number);
  return fault == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

std::size_t elements_in(xml_node list) {
  const auto elements = list.children();
  return static_cast<std::size_t>(std::count_if(
      elements.begin(), elements.end(), [](xml_node n) { return n.type() == pugi::node_element; }));
}

// Walks without recursion, however deep the document is.
struct Lists : pugi::xml_tree_walker {
  explicit Lists(const QifDocument& of) : document(of) {}

  bool for_each(xml_node& list) override {
    const bool are_referred = std::ranges::find(kReferred, list.name()) != kReferred.end();
    if (are_referred || std::ranges::find(kCounted, list.name()) != kCounted.end()) count(list);
    if (are_referred && !fault) look_at_ids(list);
    return !fault;
  }

  void count(xml_node list) {
    const auto stated = list.attribute("n");
    if (!stated) return;
    const std::size_t found = elements_in(list);
    if (whole_number(stated.value()) == found) return;
    fault = document.fault(
        list, "element-count"_id,
        fmt::format("states n=\"{}\", it has {}", stated.value(), counted(found, "element")),
        "as many elements as n says are expected: is the document whole?");
  }
  void look_at_ids(xml_node list) {
    for (const xml_node each : list) {
      if (fault || each.type() != pugi::node_element) continue;
      const auto id = each.attribute("id");
      if (!id) {
        fault = document.fault(each, "bad-reference"_id, "has no id",
                               "a whole number is expected, by which others refer to it");
      } else if (!whole_number(id.value())) {
        fault = document.fault(each, "bad-reference"_id, "has an id that is not a whole number",
                               "a number from 1 on is expected, by which others refer to it");
      }
    }
  }

  const QifDocument& document;
  std::optional<Diagnostic> fault{};
};

}  // namespace

void drop_prefix(xml_node root) {
  const std::string_view name = root.name();
  const std::size_t colon = name.find(':');
  if (colon == name.npos) return;
  const std::string prefix(name.substr(0, colon + 1));
  struct Walker : pugi::xml_tree_walker {
    std::string prefix{};
    bool for_each(xml_node& node) override {
      const std::string_view own = node.name();
      if (own.starts_with(prefix)) node.set_name(std::string(own.substr(prefix.size())).c_str());
      return true;
    }
  } walker;
  walker.prefix = prefix;
  root.traverse(walker);
  root.set_name(std::string(name.substr(colon + 1)).c_str());
}

std::optional<Diagnostic> list_fault(const QifDocument& document) {
  Lists lists(document);
  for (const char* name : kRead) {
    for (xml_node part : document.root().children(name)) {
      if (lists.for_each(part)) part.traverse(lists);
      if (lists.fault) return lists.fault;
    }
  }
  return std::nullopt;
}

std::optional<UnknownReference> unknown_reference(std::string_view bytes) {
  constexpr std::array<std::string_view, 5> kOfXml{"amp", "lt", "gt", "quot", "apos"};
  // In these & is a character like any other.
  struct Quoted {
    std::string_view opens, closes;
  };
  constexpr std::array kQuoted{Quoted{"<!--", "-->"}, Quoted{"<![CDATA[", "]]>"},
                               Quoted{"<?", "?>"}};
  for (std::size_t at = bytes.find_first_of("<&"); at < bytes.size();
       at = bytes.find_first_of("<&", at)) {
    const std::string_view rest = bytes.substr(at);
    if (rest.front() == '<') {
      const auto* const quoted =
          std::ranges::find_if(kQuoted, [&](const Quoted& q) { return rest.starts_with(q.opens); });
      at = quoted == kQuoted.end() ? at + 1 : bytes.find(quoted->closes, at + quoted->opens.size());
      continue;
    }
    const std::size_t end = rest.find_first_of(";<&\"' \t\r\n", 1);
    const bool ends = end != rest.npos && rest[end] == ';';
    const std::string_view name = rest.substr(1, ends ? end - 1 : 0);
    const bool is_known = name.starts_with('#') || std::ranges::find(kOfXml, name) != kOfXml.end();
    if (ends && !is_known) return UnknownReference{at, rest.substr(0, end + 1)};
    ++at;
  }
  return std::nullopt;
}

}  // namespace frustum::metrology
