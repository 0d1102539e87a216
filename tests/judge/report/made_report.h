#pragma once
#include <cmath>

#include "judge/report/report.h"

namespace limpid::test {

/// A small report of invented numbers; `name` is the name of a subject.
inline Report made_report(const std::string& name = "pond") {
  Report report;
  report.made = "2001-02-03T04:05:06Z";
  report.machine = {"an <abacus>", "Debian", "6.1", 2, {"avx2", "scalar"}};
  report.build = {"1.2.3", "GNU 12", "Release", "none"};
  report.size = {64, 36};
  report.rounds = 3;
  report.threads = 2;
  report.simd = "avx2";
  report.subjects = {{name, "plate", name + ".toml", {64, 36}, 0.5}};
  report.looks = {"physical", "fast"};
  double ns = 100;
  for (const std::string& look : report.looks) {
    report.runners.push_back({name, look, "reference", "", 1, 2, 10 * ns, {}});
    report.runners.push_back({name, look, "fused", "avx2", 1, 3, ns, {1e-7, 1e-6, 1e-5, 1e-4}});
    report.runners.push_back(
        {name, look, "fused", "scalar", 1, 3, 4 * ns, {2e-7, 1e-6, 1e-5, 1e-4}});
    report.runners.push_back({name, look, "fused", "avx2", 2, 3, ns / 2, {1e-7, 1e-6, 1e-5, 1e-4}});
    report.runners.push_back(
        {name, look, "gpu", "a <GPU>", 2, 3, ns / 9, {1e-7, 1e-6, 1e-5, 1e-4}});
    ns /= 2;
  }
  report.look_rows = {{name, "physical", 100, {}, {}},
                      {name, "fast", 50, {0.01, 0.1, 0.2, 0.3}, {"no prism_split"}}};
  report.truth = {{"the dry picture", 0, 0.66, 0.6},
                  {"no refraction", 20, 0.13, 0.18},
                  {"snell march, shorten", 160, 0.031, 0.023}};
  report.truth_in_frame_share = 0.75;
  report.truth_size = {96, 54};
  for (const std::string& look : report.looks) {
    report.models.push_back({name,
                             look,
                             "",
                             "",
                             90,
                             {0.02, 0.1, 0.2, 0.3},
                             0.03,
                             0.01,
                             0.9,
                             0.1,
                             0.2,
                             0.001,
                             0.4,
                             2.5,
                             0.03,
                             0.01});
  }
  report.models.push_back({name,
                           "physical",
                           "refraction.rejection",
                           "snap",
                           80,
                           {0.03, 0.1, 0.2, 0.3},
                           0.04,
                           0.02,
                           0.8,
                           0.2,
                           0.3,
                           0.002,
                           0.5,
                           3.5,
                           0.04,
                           0.02});
  report.brought_subjects = {{name, 0.66, 0.5, 0.9}};
  for (const std::string& look : report.looks) {
    report.brought.push_back({name, look, "color, depth", 90, 0.23, 0.21, 0.41, 0.3});
    report.brought.push_back({name, look, "shadow", 88, 0.22, 0.2, std::nan(""), 0.29});
    report.brought.push_back({name, look, "reflection", 60, 0.15, 0.12, 0.4, 0.15});
  }
  report.choices_subject = name;
  report.choices = {{"", "", 100, {}}, {"refraction.steps", "0", 60, {0.006, 0.1, 0.2, 0.3}}};
  report.budgets = {{name, "physical", 0, 100, {}, 0, 0.4, 0, 0.5},
                    {name, "physical", 0.01, 80, {1e-3, 4e-3, 8e-3, 9e-3}, 0.0099, 0.4, 0.2, 0.3}};
  report.subject_figures = {{name, "a caption", {64, 36}, std::string("\xff\xd8\xff\0", 4)}};
  return report;
}

}  // namespace limpid::test
