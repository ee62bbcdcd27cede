#include "app/motion/document.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace frustum::app {

using nlohmann::ordered_json;

class DocumentWriter {
 public:
  static ordered_json of(const std::vector<Document::Field>& fields) {
    ordered_json object = ordered_json::object();
    for (const auto& [name, value] : fields) {
      object[name] = std::visit([](const auto& v) { return of(v); }, value.value_);
    }
    return object;
  }

 private:
  static ordered_json of(std::monostate) { return nullptr; }
  static ordered_json of(const std::vector<std::vector<Document::Field>>& documents) {
    ordered_json list = ordered_json::array();
    for (const auto& fields : documents) list.push_back(of(fields));
    return list;
  }
  template <typename Value>
  static ordered_json of(const Value& value) {
    return value;
  }
};

DocumentValue::DocumentValue(Document fields) : value_(fields.fields()) {}

DocumentValue::DocumentValue(const std::vector<Document>& list) {
  std::vector<std::vector<Field>> all;
  for (const Document& each : list) all.push_back(each.fields());
  value_ = std::move(all);
}

DocumentValue& Document::operator[](std::string_view name) {
  const auto at = std::ranges::find(fields_, name, &Field::first);
  if (at != fields_.end()) return at->second;
  return fields_.emplace_back(std::string(name), DocumentValue()).second;
}

std::string Document::json() const { return DocumentWriter::of(fields_).dump(1); }

}  // namespace frustum::app
