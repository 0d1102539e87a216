#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/plan/plan.h"
#include "limpid/plate/texture.h"
#include "limpid/raster/model.h"

#include "judge/report/report.h"

namespace limpid {

/// A plate or a scene with all its planes in memory, for any look.
class Subject {
 public:
  /// The plates of a scene file, reduced as ReportOptions::size says.
  static Subject of_plate(const std::filesystem::path& scene_file, Size size);
  /// The time of all pictures of the project, in seconds.
  static constexpr double kMoment = 2;
  /// The geometry of a scene file, rendered. `sky` is its surroundings if it names none; empty for
  /// none.
  static Subject of_scene(const std::filesystem::path& scene_file, Size size,
                          const std::filesystem::path& sky, Executor& executor,
                          double time = kMoment);
  /// Camera, water and light of a scene with this model for the geometry, in such a picture.
  static Scene scene_of(const SceneFile& file, const Model& model, Size size);
  /// As of_scene(), with this model for the geometry.
  static Subject of_model(const std::filesystem::path& scene_file, const Model& model, Size size,
                          const std::filesystem::path& sky, Executor& executor,
                          double time = kMoment);

  const ReportSubject& facts() const { return facts_; }
  Rect window() const { return frame_.work(); }
  double pixels() const { return static_cast<double>(window().area()); }
  const Scene& scene() const { return scene_; }

  PlaneSet planes() const { return frame_.present(); }
  /// Reduces the frame to these of its planes, without surroundings.
  void bring(PlaneSet planes);
  /// Gives the scene these waves.
  void make_waves(std::vector<SineWave> waves) { scene_.water->waves = std::move(waves); }

  Plan plan(const Look& look, double max_error = 0, StateSet outputs = {}) const;
  /// The frame with the maps that the plan reads, which stay loaded.
  Frame frame_for(const Plan& plan);

 private:
  void describe(const std::filesystem::path& scene_file, std::string kind);

  ReportSubject facts_;
  Scene scene_;
  Frame frame_;
  std::vector<Plane> planes_;
  LoadedTexture environment_;
  std::map<std::string, LoadedTexture> wave_maps_;
};

}  // namespace limpid
