#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/plane.h"
#include "limpid/core/scene.h"
#include "limpid/ops/look.h"
#include "limpid/plan/plan.h"
#include "limpid/plate/plate.h"
#include "limpid/run/target.h"

namespace limpid {

/// Error of a picture against the truth: mean |picture - truth| over mean truth, of red, green and
/// blue together, larger values counted as Lagoon::kBrightest (glints reach 3700).
struct TruthError {
  double wet = 0;       ///< over all wet pixels
  double in_frame = 0;  ///< over wet pixels whose bottom the dry picture shows
};

/// The plate lagoon with calm water, and its path-traced picture as the truth. A wet pixel is `in
/// frame` if the look of truth_look() finds the bottom: other pixels see a bottom outside of the
/// dry picture, where any error is one of guessing.
class Lagoon {
 public:
  static constexpr double kBrightest = 4;

  /// `folder` is data/plates/lagoon. Throws Error as Plate does.
  explicit Lagoon(const std::filesystem::path& folder);

  /// The look with the water of the truth (see the README of the plate).
  static Look with_its_water(Look look);
  /// The look with that water, march and rejection shorten.
  static Look truth_look();
  /// The waves of the plate's normals and of `truth_waves` (see the README of the plate), which do
  /// not move.
  static std::vector<SineWave> waves();

  /// A model of refraction, otherwise truth_look().
  struct Refracted {
    std::string name;
    Look look;
  };
  /// No refraction, then each number of steps with each rejection.
  static std::vector<Refracted> refraction_variants();

  Rect window() const { return plate_.frame.work(); }
  Plan plan(const Look& look, StateSet outputs = {}) const;
  /// One fused pass.
  void run(const Plan& plan, const Target& target, Executor& executor,
           const std::string& simd = {}) const;

  TruthError error_of(const std::array<View<const float>, 3>& color) const;
  /// The dry picture.
  std::array<View<const float>, 3> dry() const;
  std::array<View<const float>, 3> truth() const;
  double wet_share() const;       ///< of all pixels
  double in_frame_share() const;  ///< of the wet ones

 private:
  bool wet(int x, int y) const;

  Scene scene_;
  LoadedPlate plate_;
  std::array<Plane, 3> truth_;
  Plane sure_;  ///< confidence of the look of truth_look()
};

}  // namespace limpid
