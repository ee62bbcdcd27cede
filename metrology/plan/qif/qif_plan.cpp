#include "metrology/plan/qif/qif_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <pugixml.hpp>

#include "core/name_index.hpp"
#include "core/toml_document.hpp"
#include "metrology/plan/qif/qif_agreement.hpp"
#include "metrology/plan/qif/qif_kinds.hpp"
#include "metrology/plan/qif/qif_stated.hpp"

namespace frustum::metrology {
namespace {

using pugi::xml_node;

constexpr std::string_view kPrefix = "plan.";
// What elements state by text; a plan's own name of them would say it twice.
constexpr std::array<std::string_view, 3> kOfElements{"name", "feature", "features"};

bool is_of_elements(std::string_view key) {
  return std::ranges::find(kOfElements, key) != kOfElements.end();
}

struct Attribute {
  std::string value{};
  xml_node element{};
};
using Attributes = std::map<std::string, Attribute, std::less<>>;

// The text of a plan file, and which element each line is of.
class PlanText {
 public:
  void add(const std::string& line, xml_node element) {
    text_ += line + '\n';
    elements_.push_back(element);
  }
  [[nodiscard]] const std::string& text() const { return text_; }
  // Of a line, from 1; the last where there is no such line.
  [[nodiscard]] xml_node element(int line) const {
    const auto last = std::ssize(elements_);
    return elements_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(line, 1, last) - 1)];
  }

 private:
  std::string text_{};
  std::vector<xml_node> elements_{};
};

class QifPlanReader {
 public:
  QifPlanReader(const QifDocument& document, const QifStated& stated,
                const std::filesystem::path& file)
      : document_(document), stated_(stated), file_(file) {}

  Result<ReadPlan> read() {
    const PlanTexts texts = plan_texts(stated_.plan);
    const Attributes own = attributes_of(document_.root());
    is_probe_stated_ = own.contains("probe");
    add_keys(texts.root, own, document_.root());
    for (std::size_t i = 0; i < texts.features.size(); ++i) add_feature(i, texts.features[i]);
    for (std::size_t i = 0; i < texts.characteristics.size(); ++i) {
      add_characteristic(i, texts.characteristics[i]);
    }
    if (!faults_.empty()) return located(faults_);
    auto plan = parse_plan(text_.text(), {});
    if (!plan) return located(moved(plan.error()));
    note_disagreements(*plan);
    note_missing(*plan);
    if (!faults_.empty()) return located(faults_);
    return ReadPlan{*std::move(plan), located(warnings())};
  }

 private:
  Attributes attributes_of(xml_node parent) {
    Attributes found;
    for (const xml_node element : parent.child("Attributes").children()) {
      const std::string_view name = element.attribute("name").value();
      if (!name.starts_with(kPrefix)) continue;
      const std::string key(name.substr(kPrefix.size()));
      const std::string value = element.attribute("value").value();
      const auto refuse = [&](std::string_view what, const char* hint) {
        faults_.push_back(document_.fault(element, "plan-value"_id,
                                          fmt::format("name=\"{}\" {}", name, what), hint));
      };
      const bool is_key = !key.empty() && std::ranges::all_of(key, [](char c) {
        return (c >= 'a' && c <= 'z') || c == '_';
      });
      // A text over several lines would swallow the keys after it.
      const bool is_line =
          std::ranges::none_of(value,
                               [](char c) { return static_cast<unsigned char>(c) < 0x20; }) &&
          value.find("\"\"\"") == value.npos && value.find("'''") == value.npos;
      if (!is_key) {
        refuse("is no key of a plan", "plan. and a key of a plan file are expected");
      } else if (is_of_elements(key)) {
        refuse("says what elements say", "names are expected in Name and FeatureName only");
      } else if (!is_line) {
        refuse("has a value over several lines", "a TOML value on one line is expected");
      } else if (!found.emplace(key, Attribute{value, element}).second) {
        refuse("is there twice", "each key is expected once");
      }
    }
    return found;
  }

  // The keys that elements state, in whose place those of attributes go, then the other attributes.
  void add_keys(const PlanKeys& stated, const Attributes& own, xml_node element) {
    const auto add = [&](const std::string& key, const std::string& value, xml_node at) {
      if (!value.empty()) text_.add(fmt::format("{} = {}", key, value), at);
    };
    for (const PlanKey& k : stated) {
      const auto at = own.find(k.key);
      if (at == own.end()) {
        add(k.key, k.value, element);
      } else {
        add(k.key, at->second.value, at->second.element);
      }
    }
    for (const auto& [key, attribute] : own) {
      if (std::ranges::find(stated, key, &PlanKey::key) == stated.end()) {
        add(key, attribute.value, attribute.element);
      }
    }
  }

  void add_feature(std::size_t i, const PlanKeys& stated) {
    const xml_node item = stated_.features[i];
    const Attributes own = attributes_of(item);
    const PlannedFeature& feature = stated_.plan.features[i];
    if (feature.kind != FeatureKind::point && !own.contains("strategy")) unprobed_.push_back(i);
    has_extent_.push_back(own.contains("strategy") || own.contains("extent") ||
                          feature.extent != Extent());
    text_.add("[[feature]]", item);
    add_keys(stated, own, item);
  }

  void add_characteristic(std::size_t i, const PlanKeys& stated) {
    const xml_node item = stated_.characteristics[i];
    const Attributes own = attributes_of(item);
    if (std::string_view(item.name()).starts_with(kQifOtherForm) && !own.contains("kind")) {
      faults_.push_back(
          document_.fault(item, "qif-plan"_id, "does not say which form it means",
                          "AttributeStr plan.kind with a kind of characteristic is expected"));
    }
    text_.add("[[characteristic]]", item);
    add_keys(stated, own, item);
  }

  void note_disagreements(const InspectionPlan& plan) {
    for (std::size_t i = 0; i < plan.features.size(); ++i) {
      if (const char* what = disagreement(stated_.plan.features[i], plan.features[i])) {
        contradicts(stated_.features[i], what);
      }
    }
    for (std::size_t i = 0; i < plan.characteristics.size(); ++i) {
      if (const char* what =
              disagreement(stated_.plan.characteristics[i], plan.characteristics[i])) {
        contradicts(stated_.characteristics[i], what);
      }
    }
  }

  void contradicts(xml_node item, const char* what) {
    faults_.push_back(
        document_.fault(item, "qif-contradiction"_id,
                        fmt::format("has an attribute that contradicts its elements: {}", what),
                        "the attribute plan. is expected to say the same, or not to be there"));
  }

  // Of a feature whose strategy is a placeholder neither sections nor ends are known.
  void note_missing(const InspectionPlan& plan) {
    for (std::size_t i = 0; i < plan.characteristics.size(); ++i) {
      for (const std::size_t f : unprobed_) {
        const PlannedFeature& feature = plan.features[f];
        const PlannedCharacteristic& c = plan.characteristics[i];
        const bool is_named = std::ranges::find(c.features, feature.name) != c.features.end();
        const bool is_toleranced = c.features.front() == feature.name;
        if (!is_named || !(needs_sections(c.kind, feature.kind) ||
                           (is_toleranced && needs_extent(c.kind) && !has_extent_[f]))) {
          continue;
        }
        faults_.push_back(document_.fault(
            stated_.characteristics[i], "qif-plan-probing"_id,
            fmt::format("needs sections or the extent of '{}', which QIF has no element for",
                        feature.name),
            "AttributeStr plan.strategy, and plan.extent if wanted, of the feature's item are "
            "expected"));
      }
    }
  }

  static bool needs_sections(CharacteristicKind kind, FeatureKind of) {
    using enum CharacteristicKind;
    if (of == FeatureKind::circle || of == FeatureKind::line) return false;
    return kind == roundness || kind == equivalent_cone_form || kind == straightness ||
           kind == axis_straightness || kind == concentricity || kind == circular_run_out ||
           kind == line_profile;
  }
  static bool needs_extent(CharacteristicKind kind) {
    using enum CharacteristicKind;
    return kind == parallelism || kind == angularity || kind == perpendicularity ||
           kind == position || kind == coaxiality || kind == symmetry;
  }

  [[nodiscard]] Diagnostics warnings() const {
    Diagnostics found;
    const auto place = [&](Diagnostic d, xml_node element) {
      const auto [line, column] = document_.place_of(element);
      d.line = line;
      d.column = column;
      found.push_back(std::move(d));
    };
    if (!unprobed_.empty()) {
      std::vector<std::string> names;
      for (const std::size_t i : unprobed_) names.push_back(stated_.plan.features[i].name);
      place(warning("qif-plan-probing"_id,
                    fmt::format("the document does not say where to touch {}: which sections "
                                "their points are of is not known",
                                fmt::join(names, ", ")),
                    "AttributeStr plan.strategy of a feature's item says so"),
            stated_.features[unprobed_.front()]);
    }
    if (!is_probe_stated_) {
      place(warning("qif-plan-probing"_id, "the document does not state the probe's ball",
                    "AttributeStr plan.probe of the document says so"),
            document_.root());
    }
    return found;
  }

  // From lines of the text to elements.
  [[nodiscard]] Diagnostics moved(Diagnostics found) const {
    for (Diagnostic& d : found) {
      const xml_node element = text_.element(d.line);
      const std::string key = d.key.empty() ? d.key : fmt::format("({})", d.key);
      Diagnostic placed =
          document_.fault(element, d.id, fmt::format("{}: {}", key, d.message), d.hint);
      placed.severity = d.severity;
      d = std::move(placed);
    }
    return found;
  }
  [[nodiscard]] Diagnostics located(Diagnostics found) const {
    for (Diagnostic& d : found) d.file = file_.string();
    return found;
  }

  const QifDocument& document_;
  const QifStated& stated_;
  const std::filesystem::path& file_;
  PlanText text_{};
  Diagnostics faults_{};
  bool is_probe_stated_ = false;
  std::vector<std::size_t> unprobed_{};  // features without a strategy
  std::vector<bool> has_extent_{};       // of each feature
};

Diagnostics in_file(Diagnostics found, const std::filesystem::path& file) {
  for (Diagnostic& d : found) d.file = file.string();
  return found;
}

// What a document is to say of its own accord, so that it is known not to be left out.
bool is_always_said(const PlanKey& k) {
  const auto is_it = [&](const QifKind& row) {
    return row.stem == kQifOtherForm && k.value == toml_text(name_of(row.kind));
  };
  return k.key == "probe" || k.key == "strategy" ||
         (k.key == "kind" && std::ranges::any_of(kQifKinds, is_it));
}

// The keys of `whole` that are not in `stated`, or otherwise there.
PlanKeys difference(const PlanKeys& whole, const PlanKeys& stated) {
  PlanKeys keys;
  for (const PlanKey& k : whole) {
    if (is_of_elements(k.key)) continue;
    const auto at = std::ranges::find(stated, k.key, &PlanKey::key);
    if (at == stated.end() || at->value != k.value || is_always_said(k)) keys.push_back(k);
  }
  for (const PlanKey& k : stated) {
    if (is_of_elements(k.key)) continue;
    if (std::ranges::find(whole, k.key, &PlanKey::key) == whole.end()) keys.push_back({k.key, ""});
  }
  return keys;
}

std::string_view name_in(const PlanKeys& keys) {
  const auto at = std::ranges::find(keys, "name", &PlanKey::key);
  return at == keys.end() ? std::string_view() : std::string_view(at->value);
}

std::vector<PlanKeys> differences(const std::vector<PlanKeys>& whole,
                                  const std::vector<PlanKeys>& stated) {
  const NameIndex places(stated, name_in);
  std::vector<PlanKeys> keys;
  for (const PlanKeys& part : whole) {
    const auto place = places.find(name_in(part));
    keys.push_back(difference(part, place ? stated[*place] : PlanKeys()));
  }
  return keys;
}

}  // namespace

bool is_qif(std::string_view text, const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".qif") return true;
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != text.npos && text[begin] == '<';
}

Result<ReadPlan> parse_qif_plan(std::string_view bytes, const std::filesystem::path& file) {
  const auto document = QifDocument::parse(bytes);
  if (!document) return in_file(document.error(), file);
  const auto stated = qif_stated(*document);
  if (!stated) return in_file(stated.error(), file);
  return QifPlanReader(*document, *stated, file).read();
}

Result<ReadPlan> parse_plan_for_points(std::string_view text, const std::filesystem::path& file) {
  if (is_qif(text, file)) return parse_qif_plan(text, file);
  auto plan = parse_plan(text, file);
  if (!plan) return std::move(plan).error();
  return ReadPlan{*std::move(plan), {}};
}

PlanTexts unstated_keys(const InspectionPlan& plan, std::string_view document) {
  PlanTexts stated;
  if (const auto parsed = QifDocument::parse(document)) {
    if (const auto read = qif_stated(*parsed)) stated = plan_texts(read->plan);
  }
  const PlanTexts whole = plan_texts(plan);
  return {difference(whole.root, stated.root), differences(whole.features, stated.features),
          differences(whole.characteristics, stated.characteristics)};
}

}  // namespace frustum::metrology
