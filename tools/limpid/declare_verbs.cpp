#include "declare_verbs.h"

#include <limits>

#include <CLI/CLI.hpp>

#include "limpid/core/color_space.h"
#include "limpid/core/error.h"
#include "limpid/job/sequence.h"
#include "limpid/job/water.h"
#include "limpid/raster/render_plate.h"
#include "limpid/run/target.h"

#include "farm/chunks.h"
#include "judge/report/report.h"
#include "judge/trace/truth.h"
#include "option_range.h"
#include "shared_options.h"

namespace limpid::tool {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
  verb.add_option("--colorspace", a.colorspace,
                  "What red, green and blue of the plate are: " + join(color_space_names()) +
                      ", or eight numbers, x and y of red, green, blue and white (default: the "
                      "scene's, else as the plate's chromaticities say, else Rec.709)")
      ->option_text("NAME");
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
  add_display(verb, a.composite.water);
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

}  // namespace

void declare_verbs(CLI::App& app, Arguments& a) {
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
}

}  // namespace limpid::tool
