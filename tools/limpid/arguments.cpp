#include "arguments.h"

#include <iostream>
#include <limits>

#include <CLI/CLI.hpp>

#include "limpid/core/error.h"
#include "limpid/job/sequence.h"
#include "limpid/job/water.h"
#include "limpid/raster/render_plate.h"
#include "limpid/run/target.h"
#include "limpid/version.h"

#include "completion.h"
#include "farm/chunks.h"
#include "judge/report/report.h"
#include "judge/trace/truth.h"
#include "option_range.h"

namespace limpid::tool {
namespace {

constexpr int kWrongUsage = 2;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostSeconds = 1e12;  ///< so that no wave's phase overflows
constexpr double kMostFps = 1e6;

void add_plates(CLI::App& verb, std::vector<std::string>& plates, std::string& scene,
                std::vector<std::string>& layers, std::string& view) {
  verb.add_option("plates", plates, "EXR files with the buffers of one frame")
      ->option_text("PLATE...");
  verb.add_option("--scene", scene, "Scene file: plates, camera, water, sun")->option_text("FILE");
  verb.add_option(
          "--layer", layers,
          "Where a buffer comes from: ROLE=FILE:CHANNELS, ROLE=FILE, ROLE=CHANNELS or ROLE=none "
          "(repeatable)")
      ->option_text("ROLE=LAYER")
      ->allow_extra_args(false);
  verb.add_option("--view", view,
                  "Which view of a plate with several, as left or right (default: the first); "
                  "composite takes left,right or all, too, and %V in names of inputs is the view's")
      ->option_text("NAME");
}

void add_time(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--time", a.time,
                  "Seconds, for waves and their drift (default: the scene's, or 0)")
      ->option_text("S")
      ->check(number_in(-kMostSeconds, kMostSeconds, "s"));
}

void add_frame_numbers(CLI::App& verb, FrameOptions& a, const std::string& about) {
  verb.add_option("--frames", a.range, about)->option_text("RANGE");
  verb.add_option("--fps", a.fps, "Frames a second (default: 24)")
      ->option_text("N")
      ->check(number_in(1 / kMostFps, kMostFps));
}

void add_frames(CLI::App& verb, FrameOptions& a, const std::string& about) {
  add_frame_numbers(verb, a, about);
  verb.add_option("--frames-in-flight", a.in_flight,
                  "Frames that are read, run and written at once, each in its own memory "
                  "(default: 3)")
      ->option_text("N")
      ->check(whole_number_in(1, kMostInFlight));
}

void add_resume(CLI::App& verb, FrameOptions& a) {
  verb.add_flag("--resume", a.resume,
                "Leave frames alone that are there, whole, and made from the same inputs in the "
                "same way");
  verb.add_flag("--verify", a.verify,
                "With --resume: look at every byte of these frames, by the hashes they carry");
}

void add_settings(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--look", a.look, "Look by name, or a look file (default: physical)")
      ->option_text("NAME|FILE");
  verb.add_option("--set", a.settings, "One parameter: operator.parameter=value (repeatable)")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  add_time(verb, a);
}

void add_look(CLI::App& verb, WaterOptions& a) {
  add_settings(verb, a);
  std::vector<std::string> known;
  for (const AovInfo& info : aovs()) known.emplace_back(info.name);
  verb.add_option("--aov", a.aovs,
                  "Also write these terms: all, or a list of " + join(known) +
                      "; composite has motion, too, where the plate has vectors")
      ->option_text("all|NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option(
          "--max-error", a.max_error,
          "Leave out what changes no channel of a pixel by more than this in all, white = 1 "
          "(default: 0, exact)")
      ->option_text("E")
      ->check(number_in(0, kInfinity, "white = 1"));
  verb.add_flag("--strict", a.strict, "Fail instead of warning, before anything is written");
}

void add_file(CLI::App& verb, WaterOptions& a) {
  verb.add_option("-o", a.output, "EXR to write")->option_text("OUT.exr");
  verb.add_option("--compression", a.compression,
                  "none rle zips zip piz pxr24 b44 b44a dwaa dwab (default: piz)")
      ->option_text("NAME[:LEVEL]");
  verb.add_flag("--float", a.store_float, "Write float; half is the default");
}

void add_simd(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--simd", a.simd, "Instruction set (default: the best)")->option_text("NAME");
}

void add_preview(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--preview", a.preview, "Also write a picture to look at")
      ->option_text("OUT.png");
}

void add_runner(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--runner", a.runner, "fused (fast), gpu (by Vulkan) or reference (double)")
      ->option_text("NAME");
}

void add_gpu(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--gpu", a.gpu, "A part of the GPU's name (default: the fastest kind)")
      ->option_text("NAME");
}

void add_wave_samples(CLI::App& verb, CompositeArguments& a) {
  verb.add_option("--samples", a.samples,
                  "Samples a pixel of the water and its waves, of plates one; takes N times as "
                  "long (default: 1)")
      ->option_text("N")
      ->check(whole_number_in(1, OutputChoice::kMostWaveSamples));
}

void add_picture(CLI::App& verb, WaterOptions& a) {
  add_file(verb, a);
  verb.add_option("--aov-names", a.aov_names,
                  "What picture and AOVs are called: limpid, nuke, blender or arnold "
                  "(default: limpid)")
      ->option_text("HOST");
  add_simd(verb, a);
  add_preview(verb, a);
  verb.add_option("--contact-sheet", a.contact_sheet,
                  "Also write the picture and every AOV, small and named, in one picture")
      ->option_text("OUT.png");
  verb.add_flag("--show{auto}", a.show,
                "Show the preview in the terminal, where that can: by itself, or --show=kitty, "
                "--show=iterm, --show=sixel");
  verb.add_option("--deep", a.deep,
                  "Also write the water as deep samples, always compressed by zips")
      ->option_text("OUT.exr");
  add_runner(verb, a);
  add_gpu(verb, a);
  verb.add_flag("-n", a.dry_run, "Print the plan, write nothing");
}

void add_shader(CLI::App& app, ShaderArguments& a) {
  CLI::App& verb = *app.add_subcommand("shader", "Write a look as a shader for other programs");
  verb.add_option("--look", a.water.look, "Look by name, or a look file (default: physical)")
      ->option_text("NAME|FILE");
  verb.add_option("--set", a.water.settings, "One parameter: operator.parameter=value (repeatable)")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  verb.add_option("--lang", a.language, "glsl glsl-es hlsl msl spirv (default: glsl)")
      ->option_text("NAME");
  verb.add_option("--planes", a.planes,
                  "Buffers that the host has besides color and depth, as shadow,surface_depth")
      ->option_text("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--scene", a.scene,
                  "Scene file: its water, waves, sun, sky and environment; without --planes the "
                  "frame that its plates hold, whose buffers are then written, too")
      ->option_text("FILE.toml");
  verb.add_option("--main", a.main,
                  "Add a main(): none, compute or fragment (default: none, the function alone)")
      ->option_text("STAGE");
  verb.add_option("--function", a.function, "Name of the function (default: limpid_water)")
      ->option_text("NAME");
  verb.add_option("--descriptor-set", a.descriptor_set, "Of all that it declares (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, 31));
  verb.add_option("--first-binding", a.first_binding, "Bindings count from here (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, 1000));
  verb.add_option("--aov", a.aovs, "Return these terms, too, as path,normal")
      ->option_text("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("-o", a.output,
                  "File to write, with FILE.json and its maps beside it (default: the text alone, "
                  "to the standard output)")
      ->option_text("FILE");
}

void add_plate_options(CLI::App& verb, CompositeArguments& a) {
  add_plates(verb, a.plates, a.scene, a.layers, a.view);
  verb.add_option("--depth-kind", a.depth_kind,
                  "What depth planes hold: eye, ray, inverse, normalised, device (default: the "
                  "scene's, or eye)")
      ->option_text("KIND");
  verb.add_option("--depth-nothing", a.depth_nothing,
                  "What depth planes hold where nothing was hit, as 0 (default: the scene's, and 0 "
                  "where alpha is 0)")
      ->option_text("Z");
}

void add_composite(CLI::App& verb, CompositeArguments& a) {
  add_plate_options(verb, a);
  add_frames(verb, a.frames,
             "Frames, as in 1-100x2: their numbers go into the names of plates, layers, scene and "
             "outputs with %04d or ####. Frame F is at --time + F / --fps, or at its plate's own "
             "time where neither is given and the plate has one");
  add_look(verb, a.water);
}

void add_view(CLI::App& app, ViewArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "view", "Tune a look in a browser while it is composited: PLATE... --scene S");
  add_plate_options(verb, a.composite);
  add_frame_numbers(verb, a.composite.frames,
                    "Frames to choose from, as in 1-100x2: their numbers go into the names of "
                    "plates, layers, scene and reference with %04d or ####");
  add_settings(verb, a.composite.water);
  add_wave_samples(verb, a.composite);
  add_simd(verb, a.composite.water);
  add_runner(verb, a.composite.water);
  add_gpu(verb, a.composite.water);
  verb.add_option("--reference", a.reference,
                  "A picture of the same size to compare with, as a ray-traced one")
      ->option_text("FILE");
  verb.add_option("--folder", a.folder, "Where looks are saved (default: the current folder)")
      ->option_text("DIR");
  verb.add_option("--port", a.port, "Of 127.0.0.1, where the page is (default: 0, any)")
      ->option_text("N")
      ->check(whole_number_in(0, 65535));
  verb.add_flag("--no-browser", a.no_browser, "Print the page's address and open no browser");
}

void add_looks(CLI::App& app, LooksArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("looks", "List looks and presets, or show each in a picture");
  add_plate_options(verb, a.composite);
  add_time(verb, a.composite.water);
  add_simd(verb, a.composite.water);
  add_runner(verb, a.composite.water);
  add_gpu(verb, a.composite.water);
  verb.add_option(
          "--pictures", a.pictures,
          "Write all of them side by side, in the order of the list, on the plate (default: "
          "the lagoon that comes with limpid) at half its size: .png, .jpg or .tif")
      ->option_text("FILE");
}

constexpr const char* kRenderedFrames =
    "Frames, as in 1-100x2: frame F is at --time + F / --fps, and its number goes into names with "
    "%04d or ####";

void add_scene(CLI::App& verb, std::string& scene, std::string& size, bool& draw_what_you_can) {
  verb.add_option("scene", scene, "Scene file with [geometry]")
      ->required()
      ->option_text("SCENE.toml");
  verb.add_option("--size", size, "Pixels (default: 1920x1080)")->option_text("WxH");
  verb.add_flag("--draw-what-you-can", draw_what_you_can,
                "Leave out nodes of the glTF file that cannot be drawn, and list them");
}

void add_render(CLI::App& verb, RenderArguments& a) {
  add_scene(verb, a.scene, a.size, a.draw_what_you_can);
  verb.add_option("--overscan", a.overscan, "Pixels beyond each side (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, kMostRenderedSide / 2));
  verb.add_option("--shadow-map", a.shadow_map, "Texels a side (default: 2048)")
      ->option_text("N")
      ->check(whole_number_in(1, kMostShadowMap));
  add_frames(verb, a.frames, kRenderedFrames);
}

CLI::App& add_truth(CLI::App& app, TruthArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("truth", "Trace a scene's rays, to judge by: SCENE.toml -o OUT.exr");
  add_scene(verb, a.scene, a.size, a.draw_what_you_can);
  verb.add_option("--samples", a.samples, "N x N samples a pixel; 1 is its centre (default: 1)")
      ->option_text("N")
      ->check(whole_number_in(1, kMostTruthSamples));
  verb.add_option("--light", a.light,
                  "paths: scattered and bounced any number of times; once: scattered once, in "
                  "closed form (default: paths)")
      ->option_text("NAME");
  verb.add_option("--paths", a.paths, "Random ways of light for each sample (default: 16)")
      ->option_text("N")
      ->check(whole_number_in(1, kMostTruthPaths));
  verb.add_option("--photons", a.photons,
                  "Of the sun, through the waves, which focus them on the bottom (default: 0, the "
                  "sun comes through the calm plane)")
      ->option_text("N")
      ->check(whole_number_in(0, kMostTruthPhotons));
  verb.add_option("--seed", a.seed,
                  "Of where in the pixel samples lie, and of the paths (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, std::numeric_limits<std::uint64_t>::max()));
  add_frame_numbers(verb, a.frames, kRenderedFrames);
  add_settings(verb, a.water);
  verb.add_option("--aov", a.water.aovs,
                  "Also write these: all, or a list of the AOVs of water but confidence "
                  "and those of buffers, and visible, where the dry picture shows what the "
                  "refracted ray meets, with "
                  "visible_below, where that of what lies below the water alone does")
      ->option_text("all|NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_file(verb, a.water);
  add_preview(verb, a.water);
  return verb;
}

void add_compare(CLI::App& app, CompareArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("compare", "Compare two pictures: A B, B is the one to trust");
  verb.add_option("a", a.a, "Picture")->required()->option_text("A");
  verb.add_option("b", a.b, "Picture to compare with")->required()->option_text("B");
  verb.add_option("--channels", a.channels,
                  "Only these channels, and those of these layers; A=B is channel or layer A of "
                  "the first picture with B of the second (default: all; of several parts those of "
                  "the first, the others' are PART.CHANNEL)")
      ->option_text("NAME|A=B,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--tolerance", a.tolerance, "Largest difference of a pixel (default: 1e-6)")
      ->option_text("D")
      ->check(number_in(0, kInfinity));
  verb.add_option("--allowed-percent", a.allowed_percent,
                  "Share of pixels that may exceed it (default: 0)")
      ->option_text("P")
      ->check(number_in(0, 100, "%"));
  verb.add_option("--hard-limit", a.hard_limit, "Difference that no pixel may exceed")
      ->option_text("D")
      ->check(number_in(0, kInfinity));
  verb.add_option("--epsilon", a.epsilon,
                  "Of relMSE = mean((a-b)^2 / (b^2 + epsilon)) (default: 0.01)")
      ->option_text("E")
      ->check(number_above_zero());
  verb.add_option("--clip", a.clip, "Count larger values as this one")
      ->option_text("MAX")
      ->check(number_in(-kInfinity, kInfinity));
  verb.add_option(
          "--metrics", a.metrics,
          "Tell these, too: all, or a list of ssim, flip, hdrflip (of R, G, B, scene-linear "
          "in EXR, HDR and PFM, else encoded as sRGB) and offset (of the AOVs of A and of a "
          "ray-traced B: its visible, or visible_below where A says that it was made with what "
          "lies below the water alone)")
      ->option_text("all|NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--ppd", a.ppd, "Pixels a degree, of flip and hdrflip (default: 67.02)")
      ->option_text("N")
      ->check(number_in(1, 1000));
  verb.add_option("--diff", a.diff, "Write a heat map of the differences")->option_text("OUT.png");
  verb.add_option("--flip-map", a.flip_map,
                  "Write a heat map of flip, or of hdrflip where only that is among the metrics")
      ->option_text("OUT.png");
  verb.add_option(
          "--frames", a.frames,
          "Frames, as in 1-100x2: their numbers go into all names with %04d or ####. A line "
          "a frame, with the change from the one before beyond the change in B (flicker)")
      ->option_text("RANGE");
}

void add_report(CLI::App& app, ReportArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "report",
      "Measure time and error of looks, runners and models, or of a shot: [PLATE... --scene S] -o "
      "FOLDER");
  verb.add_option("-o", a.output, "Folder for index.html and report.json, made if need be")
      ->option_text("FOLDER");
  add_plate_options(verb, a.composite);
  a.composite.water.look = "";
  add_settings(verb, a.composite.water);
  add_wave_samples(verb, a.composite);
  add_simd(verb, a.composite.water);
  verb.add_option("--truth", a.truth,
                  "Of a shot: the picture with its water as it really is, of the same size")
      ->option_text("FILE");
  verb.add_option(
          "--against", a.against,
          "Of a shot: one more look to compare with, besides physical and fast (repeatable)")
      ->option_text("NAME|FILE")
      ->allow_extra_args(false);
  verb.add_option("--size", a.size, "Pixels of rendered scenes (default: 480x270; quick: 160x90)")
      ->option_text("WxH");
  verb.add_option("--rounds", a.rounds, "Timed runs; the best counts (default: 5; quick: 2)")
      ->option_text("N")
      ->check(whole_number_in(1, kMostRounds));
  verb.add_flag("--quick", a.quick, "Small pictures, few rounds: to see that it works");
  verb.add_option("--gpu", a.gpu,
                  "Measure a GPU, too: a part of its name (default: one that is not software)")
      ->option_text("NAME");
  verb.add_flag("--hard", a.hard,
                "The hard cases with their bounds instead, also printed: hard.html and hard.json");
}

void add_farm(CLI::App& app, FarmArguments& a) {
  CLI::App& verb = *app.add_subcommand("farm",
                                       "Have a sequence made by many tasks: -- "
                                       "composite|water|truth ... --frames RANGE; and status, "
                                       "watch or cancel FARM");
  verb.add_option("words", a.words,
                  "What to do with a farm: status, watch or cancel, and its folder")
      ->option_text("[status|watch|cancel FARM]");
  verb.add_option("--chunk", a.chunk,
                  "Frames a task (default: of about two minutes, by one frame that is made first)")
      ->option_text("N")
      ->check(whole_number_in(1, kMostFramesATask));
  verb.add_option("--local", a.at_once, "Without a scheduler: here, so many tasks at a time")
      ->option_text("N")
      ->check(whole_number_in(1, 1024));
  verb.add_option("--time-limit", a.minutes,
                  "Minutes that a task may take (default: four times what the frame made first "
                  "lets expect, and 5; with --chunk the partition's)")
      ->option_text("MINUTES")
      ->check(whole_number_in(1, 1'000'000));
  verb.add_option("--sbatch", a.sbatch,
                  "One more option of sbatch, as in --sbatch=--partition=render (repeatable)")
      ->option_text("OPTION")
      ->allow_extra_args(false);
  verb.add_flag("--dry-run", a.dry_run, "Check the inputs and print the scripts, submit nothing");
}

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// What is wrong with the first word that nobody expected.
std::string unexpected(const CLI::App& app) {
  const std::vector<std::string> rest = app.remaining(true);
  const std::string word = rest.empty() ? "" : rest.front().substr(0, rest.front().find('='));
  const bool is_option = word.starts_with('-');
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  if (parsed.empty() && !is_option) {
    const std::vector<std::string> verbs = verbs_of(app);
    return "'" + word + "' is no verb: expected one of " + join(verbs) + did_you_mean(word, verbs);
  }
  const std::string verb = parsed.empty() ? "" : " " + parsed.front()->get_name();
  if (!is_option) return "limpid" + verb + ": '" + word + "' is one argument too many";
  std::vector<std::string> known = options_of(app);
  if (!parsed.empty()) {
    for (const std::string& name : options_of(*parsed.front())) known.push_back(name);
  }
  return "limpid" + verb + " has no option '" + word + "': limpid help" + verb +
         " lists what there is" + did_you_mean(word, known);
}

std::string sentence_of(const CLI::ParseError& error, const CLI::App& app) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return unexpected(app);
  std::string text = error.what();
  if (dynamic_cast<const CLI::ValidationError*>(&error)) {
    return text.erase(text.find(": "), 1);  // "--fps: 0: expected ..."
  }
  constexpr std::string_view kNoNumber = "Could not convert: ";
  if (text.starts_with(kNoNumber)) return text.substr(kNoNumber.size()) + ": expected a number";
  return text;
}

/// The first option of the verb that was given an empty word, as a sentence; "" where none was.
std::string empty_word(const CLI::App& app) {
  for (const CLI::App* verb : app.get_subcommands()) {
    for (const CLI::Option* option : verb->get_options()) {
      for (const std::string& word : option->results()) {
        if (word.empty()) return option->get_name() + " '': expected " + option->get_option_text();
      }
    }
  }
  return "";
}

/// Where `--` of `limpid farm ... --` stands, else the end: what follows it is another command
/// line.
int end_of_own_words(int argc, char** argv) {
  int at = 1;
  while (at < argc && argv[at][0] == '-') ++at;
  if (at == argc || std::string_view(argv[at]) != "farm") return argc;
  while (at < argc && std::string_view(argv[at]) != "--") ++at;
  return at;
}

}  // namespace

Parsed parse(int argc, char** argv) {
  Parsed parsed;
  Arguments& a = parsed.arguments;
  CLI::App app{"limpid puts water into pictures that were rendered without it.", "limpid"};
  app.set_version_flag("--version", std::string("limpid ") + kVersion);
  app.require_subcommand(0, 1);
  app.fallthrough();
  app.set_help_all_flag("--help-all", "Help of all verbs");
  app.add_option("--threads", a.common.threads, "Threads; 0, the default, is one a core")
      ->option_text("N")
      ->check(whole_number_in(0, 1024));
  app.add_option("--max-memory", a.common.max_memory,
                 "Most memory to take, from 16M up; a job or file that needs more is refused "
                 "(default: 8G a file)")
      ->option_text("SIZE");
  app.add_flag("-q", a.common.quiet, "Print nothing but errors");
  app.add_flag("-v", a.common.verbose, "Print the plan and where buffers came from");
  app.footer("Exit codes: 0 done, 1 failed, 2 wrong usage, 75 failed in a way worth trying again.");

  CLI::App& composite =
      *app.add_subcommand("composite", "Put water into a plate: PLATE... -o OUT.exr");
  add_composite(composite, a.composite);
  add_resume(composite, a.composite.frames);
  composite
      .add_option("--missing", a.composite.frames.missing,
                  "What becomes of frames whose plate is not there: error (default), skip (no "
                  "output), or hold (the nearest before stands in)")
      ->option_text("error|skip|hold");
  add_picture(composite, a.composite.water);
  add_wave_samples(composite, a.composite);
  composite
      .add_option("--pass-through", a.composite.pass_through,
                  "Other layers of the plates that are written beside the picture as they are: all "
                  "but the color, none, or layers by name, * and ? allowed (default: none)")
      ->option_text("all|none|NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  composite
      .add_option("--overscan", a.composite.overscan,
                  "Pixels beyond each side of the picture that are written, too, as far as all "
                  "layers that are read have them (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, OutputChoice::kMostOverscan));

  CLI::App& water =
      *app.add_subcommand("water", "Render a scene and put water into it: SCENE.toml -o OUT.exr");
  add_render(water, a.render);
  water
      .add_option("--samples", a.render.samples,
                  "N x N samples a pixel, filtered after the water is in (default: 1)")
      ->option_text("N")
      ->check(whole_number_in(1, kMostSamples));
  add_resume(water, a.render.frames);
  add_look(water, a.render.water);
  add_picture(water, a.render.water);

  CLI::App& render =
      *app.add_subcommand("render", "Render a scene's buffers: SCENE.toml -o PLATE.exr");
  add_render(render, a.render);
  add_resume(render, a.render.frames);
  add_time(render, a.render.water);
  add_file(render, a.render.water);
  add_simd(render, a.render.water);

  CLI::App& truth = add_truth(app, a.truth);
  add_resume(truth, a.truth.frames);

  CLI::App& plan =
      *app.add_subcommand("plan", "Say what would run for a plate and a look, and why");
  add_composite(plan, a.composite);
  add_runner(plan, a.composite.water);
  plan.add_flag("--measure", a.composite.measure,
                "Also run it, and say how long each operator took; nothing is written");

  add_view(app, a.view);

  CLI::App& inspect =
      *app.add_subcommand("inspect", "Say what is in plates and what would be used");
  add_plates(inspect, a.inspect.plates, a.inspect.scene, a.inspect.layers, a.inspect.view);

  CLI::App& operators = *app.add_subcommand("operators", "The chain and its parameters");
  CLI::Option* name =
      operators.add_option("name", a.operators.name, "One operator")->option_text("NAME");
  CLI::Option* look = operators.add_option("--look", a.operators.look, "Show the values of a look")
                          ->option_text("NAME|FILE");
  CLI::Option* scene =
      operators.add_flag("--scene", a.operators.scene, "The keys of scene files instead")
          ->excludes(name)
          ->excludes(look);
  CLI::Option* layers =
      operators.add_flag("--layers", a.operators.layers, "The names of layers that are known")
          ->excludes(name)
          ->excludes(look)
          ->excludes(scene);
  operators.add_flag("--aovs", a.operators.aovs, "What --aov writes")
      ->excludes(name)
      ->excludes(look)
      ->excludes(scene)
      ->excludes(layers);

  add_looks(app, a.looks);
  add_compare(app, a.compare);
  add_report(app, a.report);
  add_shader(app, a.shader);
  add_farm(app, a.farm);
  const int own_words = end_of_own_words(argc, argv);
  for (int i = own_words + 1; i < argc; ++i) a.farm.command.emplace_back(argv[i]);

  std::string shell;
  CLI::App& completion = *app.add_subcommand(
      "completion", "Print a script by which a shell completes verbs and options");
  completion.add_option("shell", shell, "bash, zsh or fish")
      ->option_text("bash|zsh|fish")
      ->required();

  std::string help_verb;
  CLI::App& help = *app.add_subcommand("help", "Help of a verb, or of an operator");
  help.add_option("verb", help_verb, "Verb or operator")->option_text("VERB");

  const auto finish = [&](int code) {
    parsed.exit_code = code;
    return parsed;
  };
  try {
    app.parse(own_words, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      app.exit(error, std::cout, std::cout);
      return finish(0);
    }
    std::cerr << "limpid ERROR: " << sentence_of(error, app) << "\n";
    return finish(kWrongUsage);
  }
  if (const std::string fault = empty_word(app); !fault.empty()) {
    std::cerr << "limpid ERROR: " << fault << "\n";
    return finish(kWrongUsage);
  }
  if (completion.parsed()) {
    std::cout << completion_script(app, shell);
    return finish(0);
  }
  if (help.parsed() && !help_verb.empty()) {
    for (const CLI::App* verb : app.get_subcommands({})) {
      if (verb->get_name() != help_verb) continue;
      std::cout << verb->help("limpid");
      return finish(0);
    }
    a.verb = Verb::kOperators;
    a.operators.name = help_verb;
    a.operators.verbs = verbs_of(app);
    return parsed;
  }
  if (help.parsed() || app.get_subcommands().empty()) {
    // App::help() would give the help of the verb, which is `help`.
    std::cout << app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
    return finish(help.parsed() ? 0 : kWrongUsage);
  }
  a.verb = composite.parsed() ? (a.composite.water.dry_run ? Verb::kPlan : Verb::kComposite)
           : plan.parsed()    ? Verb::kPlan
           : water.parsed()   ? Verb::kWater
           : render.parsed()  ? Verb::kRender
           : truth.parsed()   ? Verb::kTruth
           : app.got_subcommand("view")    ? Verb::kView
           : inspect.parsed()              ? Verb::kInspect
           : operators.parsed()            ? Verb::kOperators
           : app.got_subcommand("looks")   ? Verb::kLooks
           : app.got_subcommand("compare") ? Verb::kCompare
           : app.got_subcommand("shader")  ? Verb::kShader
           : app.got_subcommand("farm")    ? Verb::kFarm
                                           : Verb::kReport;
  return parsed;
}

}  // namespace limpid::tool
