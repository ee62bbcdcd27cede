// Numbers of as many machines as a register holds. Included inside the namespaces of
// lane_kernel.cpp, which have kWidth: hence no #pragma once.
//
// Units  : those of what it computes
// Errors : none

using Number = double __attribute__((vector_size(kWidth * sizeof(double))));
using Mask = std::int64_t __attribute__((vector_size(kWidth * sizeof(std::int64_t))));

struct Vector {
  Number x, y, z;
};
struct Place {
  Vector tip, axis;
};

static inline Number all(double value) { return value - Number{}; }
static inline Vector all(const double* v) { return {all(v[0]), all(v[1]), all(v[2])}; }
// Of the lanes from `first` on.
static inline Number load(const Lanes& lanes, std::size_t first) {
  Number n;
  __builtin_memcpy(&n, lanes.of.data() + first, sizeof n);
  return n;
}
static inline Vector load(const LaneVec3& v, std::size_t first) {
  return {load(v.x, first), load(v.y, first), load(v.z, first)};
}
static inline void store(Lanes& lanes, std::size_t first, const Number& n) {
  __builtin_memcpy(lanes.of.data() + first, &n, sizeof n);
}
static inline void store(LaneVec3& to, std::size_t first, const Vector& v) {
  store(to.x, first, v.x);
  store(to.y, first, v.y);
  store(to.z, first, v.z);
}

static inline Number root(const Number& x) {
  Number r{};
  for (std::size_t i = 0; i < kWidth; ++i) r[i] = __builtin_sqrt(x[i]);
  return r;
}
static inline bool any(const Mask& mask) {
  std::int64_t bits = 0;
  for (std::size_t i = 0; i < kWidth; ++i) bits |= mask[i];
  return bits != 0;
}
static inline Number either(const Mask& mask, const Number& yes, const Number& no) {
  return mask ? yes : no;
}
static inline Number larger(const Number& a, const Number& b) { return a > b ? a : b; }
static inline Number smaller(const Number& a, const Number& b) { return a < b ? a : b; }
static inline Number size_of(const Number& a) { return larger(a, -a); }

static inline Number dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline Vector sum(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline Vector difference(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline Vector times(const Number& f, const Vector& a) { return {f * a.x, f * a.y, f * a.z}; }
static inline Vector chosen(const Mask& mask, const Vector& yes, const Vector& no) {
  return {either(mask, yes.x, no.x), either(mask, yes.y, no.y), either(mask, yes.z, no.z)};
}
