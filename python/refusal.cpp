#include "python/refusal.hpp"

namespace frustum::python {
namespace {

namespace py = pybind11;

std::string text_of(const Diagnostics& problems) {
  std::string text;
  for (const Diagnostic& each : problems) text += (text.empty() ? "" : "\n") + to_string(each);
  return text;
}

py::dict as_dict(const Diagnostic& each) {
  py::dict of;
  of["severity"] = to_string(each.severity);
  of["id"] = std::string(each.id.text());
  of["file"] = each.file;
  of["line"] = each.line;
  of["column"] = each.column;
  of["key"] = each.key;
  of["message"] = each.message;
  of["hint"] = each.hint;
  return of;
}

}  // namespace

Refused::Refused(Diagnostics problems)
    : std::runtime_error(text_of(problems)), problems_(std::move(problems)) {}

void refuse_argument(const std::string& name, const std::string& message, const std::string& hint) {
  Diagnostic problem = error("argument"_id, message, hint);
  problem.key = name;
  throw Refused({std::move(problem)});
}

void bind_refusal(py::module_& module) {
  // Kept for as long as the interpreter lives.
  static py::handle type;
  type = py::exception<Refused>(module, "InputError", PyExc_ValueError).release();
  type.attr("__doc__") =
      "The input is wrong: `diagnostics` is a list of what is, each a dict with severity, id, "
      "file, "
      "line, column, key, message and hint.";
  type.attr("diagnostics") = py::list();
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const Refused& refused) {
      py::list list;
      for (const Diagnostic& each : refused.problems()) list.append(as_dict(each));
      py::object raised = type(refused.what());
      raised.attr("diagnostics") = std::move(list);
      PyErr_SetObject(type.ptr(), raised.ptr());
    }
  });
}

}  // namespace frustum::python
