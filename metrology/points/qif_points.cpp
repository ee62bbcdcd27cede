#include "metrology/points/qif_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>

#include "metrology/points/line_words.hpp"

namespace frustum::metrology {
namespace {

using pugi::xml_node;

Diagnostic in_qif(DiagnosticId id, std::string message, std::string hint = {}) {
  return error(id, std::move(message), std::move(hint));
}

// All numbers of a list that blanks separate; nothing where one of them is none.
std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  constexpr std::string_view kBlank = " \t\r\n";
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

class QifReader {
 public:
  explicit QifReader(PointMeaning meaning) : meaning_(meaning) {}

  Result<QifPoints> read(std::string_view bytes) {
    const auto parsed = document_.load_buffer(bytes.data(), bytes.size());
    if (!parsed) {
      return in_qif("bad-xml"_id,
                    fmt::format("no XML: {} at byte {}", parsed.description(), parsed.offset));
    }
    const xml_node root = document_.child("QIFDocument");
    if (!root) return in_qif("not-qif"_id, "the document is no QIFDocument");
    if (auto problem = take_unit(root)) return *problem;
    for (const xml_node item : root.child("Features").child("FeatureItems")) {
      names_[item.attribute("id").value()] = item.child("FeatureName").text().get();
    }
    const xml_node results = root.child("Results");
    // One set of results, or several in a list.
    for (const xml_node each :
         results.child("MeasurementResultsSet").children("MeasurementResults")) {
      if (auto problem = take_results(each)) return *problem;
    }
    for (const xml_node each : results.children("MeasurementResults")) {
      if (auto problem = take_results(each)) return *problem;
    }
    std::erase_if(found_, [](const FeaturePoints& f) { return f.points.empty(); });
    if (found_.empty()) {
      return in_qif("file-without-points"_id, "the document has no measured points",
                    "export the points of the features (MeasuredPointSets) too");
    }
    return QifPoints{std::move(found_), mm_};
  }

 private:
  using Problem = std::optional<Diagnostic>;

  Problem take_unit(xml_node root) {
    const xml_node unit = root.child("FileUnits").child("PrimaryUnits").child("LinearUnit");
    // Without a conversion the unit is the SI's own.
    const xml_node factor = unit.child("UnitConversion").child("Factor");
    constexpr double kMmPerMetre = 1e3;
    const double metres = factor ? factor.text().as_double() : 1.0;
    if (!unit || !(metres > 0.0) || !std::isfinite(metres)) {
      return in_qif("length-unit"_id, "the document states no unit of length",
                    "FileUnits/PrimaryUnits/LinearUnit says how many metres a unit is");
    }
    mm_ = as_millimetres(kMmPerMetre * metres);
    return std::nullopt;
  }

  // 0.001 times 1000 is a millimetre, whatever rounding says.
  static double as_millimetres(double mm) {
    constexpr double kRounding = 1e-12;
    for (const double exact : {1.0, 25.4, 1000.0}) {
      if (std::abs(mm / exact - 1.0) < kRounding) return exact;
    }
    return mm;
  }

  Problem take_results(xml_node results) {
    std::map<std::string, xml_node> sets;
    for (const xml_node set : results.child("MeasuredPointSets")) {
      sets[set.attribute("id").value()] = set;
    }
    for (const xml_node feature : results.child("MeasuredFeatures")) {
      const xml_node list = feature.child("PointList");
      if (!list) continue;
      const std::string item = feature.child("FeatureItemId").text().get();
      const auto name = names_.find(item);
      if (name == names_.end() || name->second.empty()) {
        return in_qif(
            "bad-reference"_id,
            fmt::format("the measured feature with id {} is of item {}, which has no name",
                        feature.attribute("id").value(), item));
      }
      FeaturePoints& points = points_of(name->second);
      for (const xml_node reference : list) {
        const auto set = sets.find(reference.text().get());
        if (set == sets.end()) {
          return in_qif("bad-reference"_id,
                        fmt::format("'{}' is measured by point set {}, which is not there",
                                    name->second, reference.text().get()));
        }
        if (auto problem = take_points(reference, set->second, points)) return problem;
      }
    }
    return std::nullopt;
  }

  // The feature's points so far.
  FeaturePoints& points_of(const std::string& name) {
    const auto is_it = [&](const FeaturePoints& f) { return f.feature == name; };
    const auto at = std::ranges::find_if(found_, is_it);
    if (at != found_.end()) return *at;
    found_.push_back({.feature = name});
    return found_.back();
  }

  Problem take_points(xml_node reference, xml_node set, FeaturePoints& points) {
    const std::string id = set.attribute("id").value();
    const auto fault = [&](DiagnosticId what, std::string_view message, const char* hint) {
      return in_qif(what, fmt::format("point set {} {}", id, message), hint);
    };
    if (set.child("CoordinateSystemId") || set.child("TranformId") || set.child("TransformId")) {
      return fault("own-frame"_id, "is in a coordinate system of its own",
                   "export the points in the frame of the part");
    }
    if (!set.child("Points")) {
      return fault("binary-points"_id, "has no Points in text", "export them as decimal numbers");
    }
    // One flag for all points, or one each.
    const std::string flags = std::string(set.child("Compensated").text().get()) + ' ' +
                              set.child("Compensations").text().get();
    const auto has = [&](const char* one, const char* other) {
      return flags.find(one) != flags.npos || flags.find(other) != flags.npos;
    };
    if (set.child("BinaryCompensated") || has("true", "1") == has("false", "0")) {
      return fault("not-compensated"_id,
                   "does not say of all points alike whether they are "
                   "compensated for the radius of the ball",
                   "export them with one flag");
    }
    if (meaning_ == PointMeaning::surface && has("false", "0")) {
      return fault("not-compensated"_id, "is not compensated for the radius of the ball",
                   "measure them as centres: --ball-centres");
    }
    if (meaning_ == PointMeaning::ball_centre && has("true", "1")) {
      return fault("compensated"_id, "is compensated for the radius of the ball",
                   "leave --ball-centres out");
    }
    const auto numbers = numbers_in(set.child("Points").text().get());
    if (!numbers || numbers->size() % 3 != 0) {
      return fault("bad-numbers"_id, "is no list of x y z", "three finite numbers a point");
    }
    const std::size_t count = numbers->size() / 3;
    std::size_t first = 1, last = count;
    if (const auto index = reference.attribute("index")) {
      first = last = static_cast<std::size_t>(index.as_ullong());
    } else if (const auto range = reference.attribute("range")) {
      const auto ends = numbers_in(range.value());
      if (!ends || ends->size() != 2 || (*ends)[0] < 1.0 || (*ends)[1] > 1e9) {
        return fault("bad-numbers"_id, "is asked for a range that is none", "first and last point");
      }
      first = static_cast<std::size_t>((*ends)[0]);
      last = static_cast<std::size_t>((*ends)[1]);
    }
    if (first < 1 || last > count || first > last + 1) {
      return fault("bad-reference"_id,
                   fmt::format("has {} points, {} to {} are asked for", count, first, last), "");
    }
    for (std::size_t i = first - 1; i < last; ++i) {
      points.points.emplace_back(mm_ * (*numbers)[3 * i], mm_ * (*numbers)[3 * i + 1],
                                 mm_ * (*numbers)[3 * i + 2]);
    }
    return std::nullopt;
  }

  PointMeaning meaning_;
  pugi::xml_document document_{};
  double mm_ = 1.0;                             // of a unit of the document
  std::map<std::string, std::string> names_{};  // by the id of the feature's item
  std::vector<FeaturePoints> found_{};
};

}  // namespace

Result<QifPoints> parse_qif_points(std::string_view bytes, PointMeaning meaning) {
  return QifReader(meaning).read(bytes);
}

}  // namespace frustum::metrology
