#include "metrology/points/qif_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>

#include "metrology/points/qif_document.hpp"

namespace frustum::metrology {
namespace {

using pugi::xml_node;

class QifReader {
 public:
  QifReader(const QifDocument& document, PointMeaning meaning)
      : document_(document), meaning_(meaning) {}

  Result<QifPoints> read() {
    const xml_node root = document_.root();
    for (const xml_node item : root.child("Features").child("FeatureItems")) {
      names_[item.attribute("id").value()] = qif_text(item.child("FeatureName"));
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
      return document_.fault(root, "file-without-points"_id, "has no measured points",
                             "export the points of the features (MeasuredPointSets) too");
    }
    return QifPoints{std::move(found_), document_.mm()};
  }

 private:
  using Problem = std::optional<Diagnostic>;

  Problem take_results(xml_node results) {
    std::map<std::string, xml_node> sets;
    for (const xml_node set : results.child("MeasuredPointSets")) {
      sets[set.attribute("id").value()] = set;
    }
    for (const xml_node feature : results.child("MeasuredFeatures")) {
      const xml_node list = feature.child("PointList");
      if (!list) continue;
      const std::string item = qif_text(feature.child("FeatureItemId"));
      const auto name = names_.find(item);
      if (name == names_.end() || name->second.empty()) {
        return document_.fault(feature, "bad-reference"_id,
                               fmt::format("is of item {}, which has no name", item),
                               "the id of an element of FeatureItems with a FeatureName");
      }
      FeaturePoints& points = points_of(name->second, feature);
      for (const xml_node reference : list) {
        const auto set = sets.find(qif_text(reference));
        if (set == sets.end()) {
          return document_.fault(reference, "bad-reference"_id,
                                 fmt::format("of '{}' names point set {}, which is not there",
                                             name->second, qif_text(reference)),
                                 "the id of a MeasuredPointSet");
        }
        if (auto problem = take_points(reference, set->second, points)) return problem;
      }
    }
    return std::nullopt;
  }

  // The feature's points so far; the first of its measurements is where they are.
  FeaturePoints& points_of(const std::string& name, xml_node measured) {
    const auto is_it = [&](const FeaturePoints& f) { return f.feature == name; };
    const auto at = std::ranges::find_if(found_, is_it);
    if (at != found_.end()) return *at;
    found_.push_back({.feature = name, .line = document_.place_of(measured).line});
    return found_.back();
  }

  Problem take_points(xml_node reference, xml_node set, FeaturePoints& points) {
    const auto fault = [&](DiagnosticId what, std::string_view message, const char* hint) {
      return document_.fault(set, what, message, hint);
    };
    if (set.child("CoordinateSystemId") || set.child("TranformId") || set.child("TransformId")) {
      return fault("own-frame"_id, "is in a coordinate system of its own",
                   "export the points in the frame of the part");
    }
    if (!set.child("Points")) {
      return fault("binary-points"_id, "has no Points in text", "export them as decimal numbers");
    }
    // One flag for all points, or one each.
    const std::string flags =
        qif_content(set.child("Compensated")) + ' ' + qif_content(set.child("Compensations"));
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
    const auto numbers = qif_numbers(set.child("Points"));
    if (!numbers || numbers->size() % 3 != 0) {
      return fault("bad-numbers"_id, "is no list of x y z", "three finite numbers a point");
    }
    const std::size_t count = numbers->size() / 3;
    const auto stated = set.attribute("count");
    if (stated && stated.as_ullong() != count) {
      return fault("point-count"_id,
                   fmt::format("states count=\"{}\", its Points are {}", stated.value(), count),
                   "as many points as count says are expected: is the set whole?");
    }
    std::size_t first = 1, last = count;
    if (const auto index = reference.attribute("index")) {
      first = last = static_cast<std::size_t>(index.as_ullong());
    } else if (const auto range = reference.attribute("range")) {
      const auto ends = qif_numbers(range.value());
      if (!ends || ends->size() != 2 || (*ends)[0] < 1.0 || (*ends)[1] > 1e9) {
        return document_.fault(reference, "bad-numbers"_id,
                               fmt::format("has the range \"{}\", which is none", range.value()),
                               "first and last point, counted from 1");
      }
      first = static_cast<std::size_t>((*ends)[0]);
      last = static_cast<std::size_t>((*ends)[1]);
    }
    if (first < 1 || last > count || first > last + 1) {
      return document_.fault(reference, "bad-reference"_id,
                             fmt::format("asks for points {} to {} of set {}, which has {}", first,
                                         last, set.attribute("id").value(), count),
                             "points are counted from 1");
    }
    const double mm = document_.mm();
    for (std::size_t i = first - 1; i < last; ++i) {
      points.points.emplace_back(mm * (*numbers)[3 * i], mm * (*numbers)[3 * i + 1],
                                 mm * (*numbers)[3 * i + 2]);
    }
    return std::nullopt;
  }

  const QifDocument& document_;
  PointMeaning meaning_;
  std::map<std::string, std::string> names_{};  // by the id of the feature's item
  std::vector<FeaturePoints> found_{};
};

}  // namespace

Result<QifPoints> parse_qif_points(std::string_view bytes, PointMeaning meaning) {
  const auto document = QifDocument::parse(bytes);
  if (!document) return document.error();
  return QifReader(*document, meaning).read();
}

}  // namespace frustum::metrology
