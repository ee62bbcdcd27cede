// The Python module frustum._frustum: what frustum/__init__.py shows.
#include "python/bind.hpp"
#include "python/refusal.hpp"

PYBIND11_MODULE(_frustum, module) {
  module.attr("__version__") = FRUSTUM_VERSION;
  frustum::python::bind_refusal(module);
  frustum::python::bind_machine(module);
  frustum::python::bind_job(module);
  frustum::python::bind_study(module);
  frustum::python::bind_answers(module);
}
