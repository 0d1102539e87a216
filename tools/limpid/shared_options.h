#pragma once
#include <string>
#include <vector>

#include "arguments.h"

namespace CLI {
class App;
}

/// @file
/// Options of several verbs.

namespace limpid::tool {

void add_plates(CLI::App& verb, std::vector<std::string>& plates, std::string& scene,
                std::vector<std::string>& layers, std::string& view);
void add_time(CLI::App& verb, WaterOptions& a);
void add_frame_numbers(CLI::App& verb, FrameOptions& a, const std::string& about);
void add_frames(CLI::App& verb, FrameOptions& a, const std::string& about);
void add_resume(CLI::App& verb, FrameOptions& a);
void add_settings(CLI::App& verb, WaterOptions& a);
void add_look(CLI::App& verb, WaterOptions& a);
void add_file(CLI::App& verb, WaterOptions& a);
void add_simd(CLI::App& verb, WaterOptions& a);
void add_display(CLI::App& verb, WaterOptions& a);
void add_preview(CLI::App& verb, WaterOptions& a);
void add_runner(CLI::App& verb, WaterOptions& a);
void add_gpu(CLI::App& verb, WaterOptions& a);
void add_wave_samples(CLI::App& verb, CompositeArguments& a);
void add_picture(CLI::App& verb, WaterOptions& a);

}  // namespace limpid::tool
