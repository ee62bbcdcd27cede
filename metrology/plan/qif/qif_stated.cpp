#include "metrology/plan/qif/qif_stated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>

#include "metrology/plan/qif/qif_elements.hpp"
#include "metrology/plan/qif/qif_kinds.hpp"
#include "metrology/plan/qif/qif_tolerance.hpp"

namespace frustum::metrology {
namespace {

using pugi::xml_node;

// "CylinderFeatureItem" without "FeatureItem"; empty where the name ends otherwise.
std::string_view stem_of(xml_node item, std::string_view ending) {
  const std::string_view name = item.name();
  return name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : std::string_view();
}

template <typename Rows>
std::string stems_of(const Rows& rows) {
  std::string all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && rows[i].stem == rows[i - 1].stem) continue;
    all += fmt::format("{}{}", all.empty() ? "" : " ", rows[i].stem);
  }
  return all;
}

// As they are in the document.
Diagnostics in_order(Diagnostics found) {
  std::ranges::stable_sort(found, [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  return found;
}

class StatedReader {
 public:
  explicit StatedReader(const QifDocument& document) : e_(document) {}

  Result<QifStated> read() {
    const xml_node root = e_.root();
    const xml_node features = root.child("Features");
    const xml_node characteristics = root.child("Characteristics");
    for (const char* list : {"FeatureDefinitions", "FeatureNominals", "FeatureItems"}) {
      e_.add_list(features.child(list));
    }
    for (const char* list :
         {"CharacteristicDefinitions", "CharacteristicNominals", "CharacteristicItems"}) {
      e_.add_list(characteristics.child(list));
    }
    e_.add_list(root.child("DatumDefinitions"));
    e_.add_list(root.child("DatumReferenceFrames"));
    if (!features.child("FeatureItems").first_child()) {
      e_.note(features ? features : root, "qif-plan"_id, "has no feature to measure",
              "Features/FeatureItems with nominals and definitions are expected");
    }
    for (const xml_node item : features.child("FeatureItems").children()) {
      if (item.type() == pugi::node_element) take_feature(item);
    }
    const xml_node definitions = characteristics.child("CharacteristicDefinitions");
    if (definitions.first_child() && !characteristics.child("CharacteristicItems").first_child()) {
      e_.note(definitions, "qif-plan"_id, "are of no characteristic",
              "Characteristics/CharacteristicItems, which are what is evaluated, are expected");
    }
    for (const xml_node item : characteristics.child("CharacteristicItems").children()) {
      if (item.type() == pugi::node_element) take_characteristic(item);
    }
    if (has_error(e_.noted())) return in_order(e_.noted());
    return std::move(stated_);
  }

 private:
  void take_feature(xml_node item) {
    const std::string_view stem = stem_of(item, "FeatureItem");
    const auto* const row = std::ranges::find(kQifFeatureKinds, stem, &QifFeatureKind::stem);
    if (row == kQifFeatureKinds.end()) {
      e_.note(item, "qif-plan"_id, "is no feature that a plan has",
              fmt::format("one of these is expected, with FeatureItem: {}",
                          stems_of(kQifFeatureKinds)));
      return;
    }
    const std::string kind(stem);
    const xml_node nominal = e_.referred(item, "FeatureNominalId", kind + "FeatureNominal");
    const xml_node definition =
        nominal ? e_.referred(nominal, "FeatureDefinitionId", kind + "FeatureDefinition")
                : xml_node();
    PlannedFeature feature;
    feature.name = qif_text(item.child("FeatureName"));
    feature.kind = row->kind;
    if (feature.name.empty()) {
      e_.note(item, "missing-element"_id, "has no <FeatureName>", "a name is expected");
    }
    refuse_constructed(item);
    if (!definition) return;
    take_geometry(feature, nominal, definition);
    const std::size_t place = stated_.features.size();
    of_item_.emplace(item.attribute("id").value(), place);
    of_nominal_.emplace(nominal.attribute("id").value(), place);
    of_name_.emplace(feature.name, place);
    stated_.plan.features.push_back(std::move(feature));
    stated_.features.push_back(item);
  }

  void refuse_constructed(xml_node item) {
    const xml_node mode = item.child("DeterminationMode").first_child();
    const xml_node how = mode.child("CheckDetails").first_child();
    const xml_node told = how ? how : mode;
    const std::string_view name = told.name();
    if (name.empty() || name == "Measured" || name == "Checked") return;
    e_.note(told, "qif-plan"_id, "is not measured by points",
            "DeterminationMode/Checked/CheckDetails/Measured is expected");
  }

  void take_geometry(PlannedFeature& f, xml_node nominal, xml_node definition) {
    using enum FeatureKind;
    const bool has_axis = f.kind == cylinder || f.kind == cone;
    f.point =
        has_axis ? e_.place(nominal.child("Axis"), "AxisPoint") : e_.place(nominal, "Location");
    if (has_axis) f.axis = e_.direction(nominal.child("Axis"), "Direction");
    if (f.kind == plane || f.kind == circle || f.kind == point) {
      f.axis = e_.direction(nominal, "Normal");
    }
    if (is_round(f.kind)) {
      f.radius = 0.5 * e_.positive_length(definition, "Diameter");
      f.side = side_of(definition);
      f.strategy = f.kind == sphere ? Strategy(SphereStrategy{}) : Strategy(SectionStrategy{});
      if (f.kind == cylinder) f.strategy = SectionStrategy{.sections = {0.0, 1.0}};
    }
    if (f.kind == plane) f.strategy = RingStrategy{.rings = {1.0}};
    if (f.kind == point) f.strategy = single_touch();
    if (f.kind == cylinder && definition.child("Length")) {
      f.extent = AxialExtent{0.0, e_.positive_length(definition, "Length")};
    }
    if (f.kind == cone) take_cone(f, definition);
    if (f.kind == line) take_line(f, nominal);
  }

  void take_cone(PlannedFeature& f, xml_node definition) {
    const bool full = !definition.child("HalfAngle") && definition.child("FullAngle");
    f.half_angle =
        full ? 0.5 * e_.angle(definition, "FullAngle") : e_.angle(definition, "HalfAngle");
    const double large = e_.length(definition, "LargeEndDistance");
    // Without it the cone is pointed.
    const double small = definition.child("SmallEndDistance")
                             ? e_.length(definition, "SmallEndDistance")
                             : -f.radius / std::tan(f.half_angle);
    if (small < large) f.extent = AxialExtent{small, large};
    f.strategy = SectionStrategy{.sections = {0.5 * (small + large), large}};
  }

  void take_line(PlannedFeature& f, xml_node nominal) {
    f.axis = e_.direction(nominal, "Direction");
    f.normal = e_.direction(nominal, "Normal");
    f.strategy = LineStrategy{};
    if (!nominal.child("Length")) return;
    const double length = e_.positive_length(nominal, "Length");
    f.strategy = LineStrategy{0.0, length};
    f.extent = AxialExtent{0.0, length};
  }

  Side side_of(xml_node definition) {
    const xml_node element = definition.child("InternalExternal");
    const std::string side = qif_text(element);
    if (side == "INTERNAL") return Side::inside;
    if (side != "EXTERNAL") {
      e_.note(element ? element : definition, "plan-value"_id,
              element ? fmt::format("is '{}'", side) : "has no <InternalExternal>",
              "INTERNAL (a hole) or EXTERNAL (a boss) is expected");
    }
    return Side::outside;
  }

  void take_characteristic(xml_node item) {
    const std::string_view stem = stem_of(item, "CharacteristicItem");
    const auto* const row = std::ranges::find(kQifKinds, stem, &QifKind::stem);
    if (row == kQifKinds.end()) {
      e_.note(item, "qif-plan"_id, "is no characteristic that a plan has",
              fmt::format("one of these is expected, with CharacteristicItem: {}",
                          stems_of(kQifKinds)));
      return;
    }
    const std::string kind(stem);
    const xml_node nominal =
        e_.referred(item, "CharacteristicNominalId", kind + "CharacteristicNominal");
    const xml_node definition = nominal ? e_.referred(nominal, "CharacteristicDefinitionId",
                                                      kind + "CharacteristicDefinition")
                                        : xml_node();
    PlannedCharacteristic c;
    c.name = qif_text(item.child("Name"));
    if (c.name.empty())
      c.name = qif_text(item.child("CharacteristicDesignator").child("Designator"));
    c.kind = row->kind;
    if (c.name.empty()) {
      e_.note(item, "missing-element"_id, "has neither <Name> nor <CharacteristicDesignator>",
              "a name is expected");
    }
    if (!definition) return;
    c.features = features_of(item, nominal);
    c.criterion = criterion_of(item.child("SubstituteFeatureAlgorithm")
                                   ? item.child("SubstituteFeatureAlgorithm")
                                   : nominal.child("SubstituteFeatureAlgorithm"));
    const auto first = c.features.empty() ? of_name_.end() : of_name_.find(c.features.front());
    const PlannedFeature* toleranced =
        first == of_name_.end() ? nullptr : &stated_.plan.features[first->second];
    take_qif_tolerance(e_, {*row, nominal, definition, toleranced}, c);
    take_datums(definition, c);
    stated_.plan.characteristics.push_back(std::move(c));
    stated_.characteristics.push_back(item);
  }

  // By their items, or, where the item names none, by their nominals.
  std::vector<std::string> features_of(xml_node item, xml_node nominal) {
    std::vector<std::string> names;
    for (const xml_node id : item.child("FeatureItemIds").children("Id")) {
      add_feature(of_item_, id, names);
    }
    if (!names.empty()) return names;
    for (const xml_node id : nominal.child("FeatureNominalIds").children("Id")) {
      add_feature(of_nominal_, id, names);
    }
    if (names.empty()) {
      e_.note(item, "missing-element"_id, "names no feature",
              "FeatureItemIds with the ids of elements of FeatureItems are expected");
    }
    return names;
  }

  using Places = std::unordered_map<std::string, std::size_t>;

  // The feature that `id` refers to.
  void add_feature(const Places& places, xml_node id, std::vector<std::string>& names) {
    const auto at = places.find(qif_text(id));
    if (at == places.end()) {
      e_.note(id, "bad-reference"_id, fmt::format("names {}, which is no feature", qif_text(id)),
              "the id of a feature is expected");
      return;
    }
    names.push_back(stated_.plan.features[at->second].name);
  }

  Criterion criterion_of(xml_node algorithm) {
    const std::string text = qif_text(algorithm.child("SubstituteFeatureAlgorithmEnum"));
    if (!algorithm || text == "DEFAULT" || text == "UNDEFINED") return Criterion::least_squares;
    const auto* const at = std::ranges::find(kQifCriteria, text);
    if (at == kQifCriteria.end()) {
      e_.note(algorithm, "plan-value"_id, fmt::format("is '{}'", text),
              fmt::format("one of these is expected: {} {} {} {} {}", kQifCriteria[0],
                          kQifCriteria[1], kQifCriteria[2], kQifCriteria[3], kQifCriteria[4]));
      return Criterion::least_squares;
    }
    return static_cast<Criterion>(at - kQifCriteria.begin());
  }

  // One datum is a feature of the characteristic, as plans name it; several are the datum system.
  void take_datums(xml_node definition, PlannedCharacteristic& c) {
    if (!definition.child("DatumReferenceFrameId")) return;
    const xml_node frame = e_.referred(definition, "DatumReferenceFrameId", "DatumReferenceFrame");
    std::vector<std::string> datums;
    for (const xml_node datum : frame.child("Datums").children("Datum")) {
      take_datum(datum, datums);
    }
    if (datums.empty()) return;
    if (datums.size() == 1 && c.kind != CharacteristicKind::position &&
        c.kind != CharacteristicKind::surface_profile &&
        c.kind != CharacteristicKind::line_profile) {
      if (c.features.size() == 1) c.features.push_back(datums.front());
      if (c.features.size() == 2 && c.features.back() != datums.front()) {
        e_.note(definition, "bad-reference"_id,
                fmt::format("has the datum '{}' by its frame, '{}' as second feature",
                            datums.front(), c.features.back()),
                "one datum is expected");
      }
      return;
    }
    datums.resize(3);
    DatumSystem system;
    system.primary = datums[0];
    system.secondary = datums[1];
    system.tertiary = datums[2];
    if (stated_.plan.datum && *stated_.plan.datum != system) {
      e_.note(definition, "qif-plan"_id, "has another datum system than one before it",
              "a plan has one datum system: one DatumReferenceFrame of several datums is expected");
    }
    stated_.plan.datum = system;
  }

  // A frame that several definitions name is read once.
  std::vector<std::string> datums_of(xml_node frame) {
    const auto [at, is_new] = frames_.try_emplace(frame.attribute("id").value());
    if (is_new) {
      for (const xml_node datum : frame.child("Datums").children("Datum")) {
        take_datum(datum, at->second);
      }
    }
    return at->second;
  }

  void take_datum(xml_node datum, std::vector<std::string>& names) {
    const xml_node simple = datum.child("SimpleDatum");
    const std::string material = qif_text(simple.child("MaterialModifier"));
    if (!simple || names.size() == 3 || (material != "NONE" && material != "REGARDLESS")) {
      e_.note(datum, "qif-plan"_id, "is no datum that a plan has",
              "up to three SimpleDatum with MaterialModifier NONE or REGARDLESS are expected");
      return;
    }
    const xml_node definition = e_.referred(simple, "DatumDefinitionId", "DatumDefinition");
    const xml_node ids = definition.child("FeatureNominalIds");
    const xml_node id = ids.child("Id");
    if (!definition) return;
    if (!id || id.next_sibling("Id")) {
      e_.note(definition, "qif-plan"_id, "is not one feature",
              "FeatureNominalIds with one Id is expected");
      return;
    }
    add_feature(of_nominal_, id, names);
  }

  QifElements e_;
  Places of_item_{}, of_nominal_{};  // features by the ids of these
  Places of_name_{};
  std::map<std::string, std::vector<std::string>> frames_{};  // datums by the frame's id
  QifStated stated_{};
};

}  // namespace

Result<QifStated> qif_stated(const QifDocument& document) { return StatedReader(document).read(); }

}  // namespace frustum::metrology
