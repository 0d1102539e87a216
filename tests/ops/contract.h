#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "limpid/ops/look.h"

#include "support.h"

/// Parameters of any operator, from its table: for the tests that every operator must pass.

namespace limpid::test {

constexpr Size kContractSize{19, 7};

template <class Op>
std::string label(std::string_view field = "") {
  return std::string(Op::kName) + "." + std::string(field);
}

/// Values to test of a parameter: the ends of its range, its default, and special values.
template <class P>
std::vector<Value> candidates(const Field<P>& field) {
  std::vector<Value> values = {field.get(P{})};
  const auto inside = [&](double x) { return x >= field.range.min && x <= field.range.max; };
  switch (field.kind) {
    case FieldKind::kReal:
      for (double x : {field.range.min, field.range.max, 0.0, 1.0}) {
        if (inside(x)) values.emplace_back(x);
      }
      break;
    case FieldKind::kColor:
      for (double x : {field.range.min, field.range.max, 0.0, 1.0}) {
        if (inside(x)) values.emplace_back(Rgb<double>{x, x, x});
      }
      break;
    case FieldKind::kChoice:
      for (std::string_view word : field.choices) values.emplace_back(std::string(word));
      break;
    case FieldKind::kText:
    case FieldKind::kDirection:  // of scenes, not of operators
    case FieldKind::kMatrix:
    case FieldKind::kFile:
      break;
    case FieldKind::kCountOrWord:
      for (double x : {field.range.min, field.range.max, 1.0}) {
        if (inside(x)) values.emplace_back(x);
      }
      for (std::string_view word : field.choices) values.emplace_back(std::string(word));
      break;
    case FieldKind::kTable:
      values.emplace_back(Rows{});
      for (double x : {field.range.min, field.range.max, 0.0, 1.0}) {
        if (inside(x)) values.emplace_back(Rows(2, std::vector<double>(field.columns.size(), x)));
      }
      break;
  }
  return values;
}

/// Calls fn(params, text) for the defaults with every pair of parameters at every candidate.
template <class Op, class Fn>
void for_each_params(Fn&& fn) {
  for (const auto& first : Op::fields()) {
    for (const auto& second : Op::fields()) {
      for (const Value& a : candidates(first)) {
        for (const Value& b : candidates(second)) {
          typename Op::Params params;
          assign(Op::kName, first, params, a);
          assign(Op::kName, second, params, b);
          fn(params, label<Op>(first.name) + " = " + to_string(a) + ", " +
                         std::string(second.name) + " = " + to_string(b));
        }
      }
    }
  }
}

/// The parameter's range, cut to values at which a picture of noise can be compared in float.
template <class Op>
typename Op::Params random_params(int seed) {
  typename Op::Params params;
  int next = 0;
  const auto random = [&] { return static_cast<double>(noise(seed, next++, 91)); };
  for (const auto& field : Op::fields()) {
    const double widest = field.unit == "uv per unit tilt" ? 0.2 : 40;
    const double least = field.range.min > 0 ? 0.5 : -widest;
    const double low = std::max(field.range.min, least), high = std::min(field.range.max, widest);
    const auto number = [&] { return low + (high - low) * random(); };
    if (field.kind == FieldKind::kReal) assign(Op::kName, field, params, number());
    if (field.kind == FieldKind::kColor) {
      assign(Op::kName, field, params, Rgb<double>{number(), number(), number()});
    }
    const auto word = [&] {
      const double count = static_cast<double>(field.choices.size());
      const auto index = static_cast<std::size_t>(std::min(random() * count, count - 1));
      return std::string(field.choices[index]);
    };
    if (field.kind == FieldKind::kChoice) assign(Op::kName, field, params, word());
    if (field.kind == FieldKind::kCountOrWord) {
      const double count = std::floor(std::min(number(), 8.0));
      assign(Op::kName, field, params, random() < 0.5 ? Value(word()) : Value(count));
    }
    if (field.kind == FieldKind::kTable) {
      Rows rows(3, std::vector<double>(field.columns.size()));
      for (std::vector<double>& row : rows) {
        for (double& x : row) x = std::clamp(2 * random() - 1, field.range.min, field.range.max);
      }
      assign(Op::kName, field, params, rows);
    }
  }
  return params;
}

/// All inputs; the plate's normals only on request, so that the maps are tested too.
struct World {
  explicit World(bool plate_normals = true)
      : buffers(noisy_frame(rect_of(kContractSize))),
        map(16, 8),
        sky(12, 6),
        scene(simple_scene(kContractSize)) {
    buffers.frame.wave_map = map.texture;
    buffers.frame.environment = sky.texture;
    if (!plate_normals) {
      for (int c = 0; c < 3; ++c) {
        buffers.frame.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
      }
    }
    scene.time = 3.7;
  }
  Buffers buffers;
  NoiseMap map, sky;
  Scene scene;
};

}  // namespace limpid::test
