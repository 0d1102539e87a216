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
  verb.add_option("--lang", a.language,
                  "Language: glsl, glsl-es, hlsl, msl or spirv (default: glsl)")
      ->option_text("NAME");
  verb.add_option("--planes", a.planes,
                  "Buffers of the host besides color and depth, such as shadow,surface_depth")
      ->option_text("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--scene", a.scene,
                  "Scene file with water, waves, sun, sky and environment. Without --planes its "
                  "plates are read and their buffers written, too")
      ->option_text("FILE.toml");
  verb.add_option(
          "--main", a.main,
          "Entry point to add: none, compute or fragment (default: none, the function alone)")
      ->option_text("STAGE");
  verb.add_option("--function", a.function, "Name of the function (default: limpid_water)")
      ->option_text("NAME");
  verb.add_option("--descriptor-set", a.descriptor_set,
                  "Descriptor set of all declarations (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, 31));
  verb.add_option("--first-binding", a.first_binding, "First binding (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, 1000));
  verb.add_option("--aov", a.aovs, "Also return these AOVs, such as path,normal")
      ->option_text("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("-o", a.output,
                  "File to write, with FILE.json and the maps beside it (default: the text alone, "
                  "to standard output)")
      ->option_text("FILE");
}

void add_plate_options(CLI::App& verb, CompositeArguments& a) {
  add_plates(verb, a.plates, a.scene, a.layers, a.view);
  verb.add_option(
          "--depth-kind", a.depth_kind,
          "Kind of the depth: eye, ray, inverse, normalised, device (default: the scene's, or eye)")
      ->option_text("KIND");
  verb.add_option("--depth-nothing", a.depth_nothing,
                  "Depth where no surface was hit, such as 0 (default: the scene's, and 0 where "
                  "alpha is 0)")
      ->option_text("Z");
  verb.add_option("--colorspace", a.colorspace,
                  "Color space of the plate: " + join(color_space_names()) +
                      ", or eight numbers, x and y of red, green, blue and white (default: the "
                      "scene's, else that of the plate's chromaticities, else Rec.709)")
      ->option_text("NAME");
}

void add_composite(CLI::App& verb, CompositeArguments& a) {
  add_plate_options(verb, a);
  add_frames(
      verb, a.frames,
      "Frames, as in 1-100x2: their numbers replace %04d or #### in the names of plates, "
      "layers, scene and outputs. The time of frame F is --time + F / --fps, or without both "
      "the time in its plate");
  add_look(verb, a.water);
}

void add_view(CLI::App& app, ViewArguments& a) {
  CLI::App& verb = *app.add_subcommand("view", "Tune a look in a browser: PLATE... --scene S");
  add_plate_options(verb, a.composite);
  add_frame_numbers(verb, a.composite.frames,
                    "Frames to choose from, as in 1-100x2: their numbers replace %04d or #### in "
                    "the names of plates, layers, scene and reference");
  add_settings(verb, a.composite.water);
  add_wave_samples(verb, a.composite);
  add_simd(verb, a.composite.water);
  add_runner(verb, a.composite.water);
  add_gpu(verb, a.composite.water);
  add_display(verb, a.composite.water);
  verb.add_option("--reference", a.reference,
                  "Picture to compare with, of the same size, such as a path-traced picture")
      ->option_text("FILE");
  verb.add_option("--folder", a.folder, "Folder for saved looks (default: the current folder)")
      ->option_text("DIR");
  verb.add_option("--port", a.port, "Port of the page on 127.0.0.1 (default: 0, any)")
      ->option_text("N")
      ->check(whole_number_in(0, 65535));
  verb.add_flag("--no-browser", a.no_browser, "Print the page's address and open no browser");
}

void add_looks(CLI::App& app, LooksArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("looks", "List looks and presets, or render each on a plate");
  add_plate_options(verb, a.composite);
  add_time(verb, a.composite.water);
  add_simd(verb, a.composite.water);
  add_runner(verb, a.composite.water);
  add_gpu(verb, a.composite.water);
  verb.add_option(
          "--pictures", a.pictures,
          "Write one picture with all looks on the plate (default: the bundled lagoon), side "
          "by side in the order of the list, at half size: .png, .jpg or .tif")
      ->option_text("FILE");
}

constexpr const char* kRenderedFrames =
    "Frames, as in 1-100x2: their numbers replace %04d or #### in names, and the time of frame F "
    "is --time + F / --fps";

void add_scene(CLI::App& verb, std::string& scene, std::string& size, bool& skip_unsupported) {
  verb.add_option("scene", scene, "Scene file with [geometry]")
      ->required()
      ->option_text("SCENE.toml");
  verb.add_option("--size", size, "Size in pixels (default: 1920x1080)")->option_text("WxH");
  verb.add_flag("--skip-unsupported", skip_unsupported,
                "Leave out unsupported nodes of the glTF file, and list them");
}

void add_render(CLI::App& verb, RenderArguments& a) {
  add_scene(verb, a.scene, a.size, a.skip_unsupported);
  verb.add_option("--overscan", a.overscan, "Pixels beyond each side of the picture (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, kMaxRenderedSide / 2));
  verb.add_option("--shadow-map", a.shadow_map, "Texels per side of the shadow map (default: 2048)")
      ->option_text("N")
      ->check(whole_number_in(1, kMaxShadowMap));
  add_frames(verb, a.frames, kRenderedFrames);
}

CLI::App& add_truth(CLI::App& app, TruthArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "truth", "Path-trace a scene, to judge pictures by: SCENE.toml -o OUT.exr");
  add_scene(verb, a.scene, a.size, a.skip_unsupported);
  verb.add_option("--samples", a.samples,
                  "N x N samples per pixel; 1 is the pixel centre (default: 1)")
      ->option_text("N")
      ->check(whole_number_in(1, kMaxTruthSamples));
  verb.add_option("--light", a.light,
                  "Light in the water: paths (multiple scattering and reflection) or once (single "
                  "scattering, in closed form) (default: paths)")
      ->option_text("NAME");
  verb.add_option("--paths", a.paths, "Random light paths per sample (default: 16)")
      ->option_text("N")
      ->check(whole_number_in(1, kMaxTruthPaths));
  verb.add_option("--photons", a.photons,
                  "Photons of the sun through the waves, for caustics (default: 0: sunlight enters "
                  "through the calm plane)")
      ->option_text("N")
      ->check(whole_number_in(0, kMaxTruthPhotons));
  verb.add_option("--seed", a.seed, "Seed of sample positions and light paths (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, std::numeric_limits<std::uint64_t>::max()));
  add_frame_numbers(verb, a.frames, kRenderedFrames);
  add_settings(verb, a.water);
  verb.add_option(
          "--aov", a.water.aovs,
          "Also write AOVs: all, or names: the AOVs of water except confidence and buffers; "
          "visible (1 where the dry picture shows the end of the refracted ray); "
          "visible_below (1 where the layer below shows it)")
      ->option_text("all|NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_file(verb, a.water);
  add_preview(verb, a.water);
  return verb;
}

void add_compare(CLI::App& app, CompareArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("compare", "Compare two pictures: A B, with B as the reference");
  verb.add_option("a", a.a, "Picture")->required()->option_text("A");
  verb.add_option("b", a.b, "Picture to compare with")->required()->option_text("B");
  verb.add_option("--channels", a.channels,
                  "Channels and layers to compare; A=B compares channel or layer A of the first "
                  "picture with B of the second, PART.CHANNEL names a channel of another part "
                  "(default: all channels of the first part)")
      ->option_text("NAME|A=B,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--tolerance", a.tolerance,
                  "Largest allowed difference of a pixel (default: 1e-6)")
      ->option_text("D")
      ->check(number_in(0, kInfinity));
  verb.add_option("--allowed-percent", a.allowed_percent,
                  "Share of pixels that may exceed the tolerance (default: 0)")
      ->option_text("P")
      ->check(number_in(0, 100, "%"));
  verb.add_option("--hard-limit", a.hard_limit, "Difference that no pixel may exceed")
      ->option_text("D")
      ->check(number_in(0, kInfinity));
  verb.add_option("--epsilon", a.epsilon,
                  "Epsilon of relMSE = mean((a-b)^2 / (b^2 + epsilon)) (default: 0.01)")
      ->option_text("E")
      ->check(number_above_zero());
  verb.add_option("--clip", a.clip, "Clamp both pictures to values up to MAX")
      ->option_text("MAX")
      ->check(number_in(-kInfinity, kInfinity));
  verb.add_option("--metrics", a.metrics,
                  "Also compute these metrics: all, or a list of ssim, flip, hdrflip (of R, G, B, "
                  "scene-linear in EXR, HDR and PFM, else sRGB) and offset (error of refracted "
                  "lookups, from the AOVs of A and of a path-traced B: its visible, or "
                  "visible_below if A was made with a layer below)")
      ->option_text("all|NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--ppd", a.ppd, "Pixels per degree, for flip and hdrflip (default: 67.02)")
      ->option_text("N")
      ->check(number_in(1, 1000));
  verb.add_option(
          "--colorspace", a.colorspace,
          "Color space of linear pictures, as for composite; ssim, flip and hdrflip convert "
          "it to Rec.709 (default: that of their chromaticities, else Rec.709)")
      ->option_text("NAME");
  verb.add_option("--diff", a.diff, "Write a heat map of the differences")->option_text("OUT.png");
  verb.add_option("--flip-map", a.flip_map,
                  "Write a heat map of flip, or of hdrflip if flip is not among the metrics")
      ->option_text("OUT.png");
  verb.add_option(
          "--frames", a.frames,
          "Frames, as in 1-100x2: their numbers replace %04d or #### in all names. Each frame has "
          "a line, with its flicker: its change since the frame before, beyond the change in B")
      ->option_text("RANGE");
}

void add_report(CLI::App& app, ReportArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "report",
      "Measure time and error of looks, runners and models, or of a shot: [PLATE... --scene S] -o "
      "FOLDER");
  verb.add_option("-o", a.output, "Folder for index.html and report.json, created if missing")
      ->option_text("FOLDER");
  add_plate_options(verb, a.composite);
  a.composite.water.look = "";
  add_settings(verb, a.composite.water);
  add_wave_samples(verb, a.composite);
  add_simd(verb, a.composite.water);
  verb.add_option("--truth", a.truth, "For a shot: the true picture with water, of the same size")
      ->option_text("FILE");
  verb.add_option(
          "--against", a.against,
          "For a shot: one more look to compare with, besides physical and fast (repeatable)")
      ->option_text("NAME|FILE")
      ->allow_extra_args(false);
  verb.add_option("--size", a.size,
                  "Size of rendered scenes in pixels (default: 480x270; quick: 160x90)")
      ->option_text("WxH");
  verb.add_option("--rounds", a.rounds, "Timed runs; the fastest counts (default: 5; quick: 2)")
      ->option_text("N")
      ->check(whole_number_in(1, kMaxRounds));
  verb.add_flag("--quick", a.quick, "Small pictures and few rounds, as a test");
  verb.add_option("--gpu", a.gpu,
                  "Also measure the GPU with this part of its name (default: a hardware device)")
      ->option_text("NAME");
  verb.add_flag("--hard", a.hard,
                "Run the hard cases instead, print them with their bounds, and write hard.html and "
                "hard.json");
}

void add_farm(CLI::App& app, FarmArguments& a) {
  CLI::App& verb = *app.add_subcommand("farm",
                                       "Split a sequence into tasks: -- composite|water|truth ... "
                                       "--frames RANGE; or status, watch, cancel FARM");
  verb.add_option("words", a.words,
                  "Action on a farm: status, watch or cancel, and the folder of the farm")
      ->option_text("[status|watch|cancel FARM]");
  verb.add_option(
          "--chunk", a.chunk,
          "Frames per task (default: about two minutes of work, estimated from one timed frame)")
      ->option_text("N")
      ->check(whole_number_in(1, kMaxFramesATask));
  verb.add_option("--local", a.at_once,
                  "Run the tasks on this machine, N at a time, without a scheduler")
      ->option_text("N")
      ->check(whole_number_in(1, 1024));
  verb.add_option("--time-limit", a.minutes,
                  "Time limit of a task in minutes (default: four times the estimate plus 5; with "
                  "--chunk the partition's)")
      ->option_text("MINUTES")
      ->check(whole_number_in(1, 1'000'000));
  verb.add_option("--sbatch", a.sbatch,
                  "One more option of sbatch, as in --sbatch=--partition=render (repeatable)")
      ->option_text("OPTION")
      ->allow_extra_args(false);
  verb.add_flag("--dry-run", a.dry_run, "Check the inputs and print the scripts; submit nothing");
}

}  // namespace

void declare_verbs(CLI::App& app, Arguments& a) {
  CLI::App& composite =
      *app.add_subcommand("composite", "Put water into a plate: PLATE... -o OUT.exr");
  add_composite(composite, a.composite);
  add_resume(composite, a.composite.frames);
  composite
      .add_option("--missing", a.composite.frames.missing,
                  "Frames without a plate: error (default), skip (no output) or hold (use the "
                  "nearest earlier plate, else the first)")
      ->option_text("error|skip|hold");
  add_picture(composite, a.composite.water);
  add_wave_samples(composite, a.composite);
  composite
      .add_option("--pass-through", a.composite.pass_through,
                  "Copy other layers of the plates into the output: all (except the color), none, "
                  "or layers by name, with * and ? (default: none)")
      ->option_text("all|none|NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  composite
      .add_option(
          "--motion-to", a.composite.motion_to,
          "Compute --aov motion and motion_reflected by camera and water of the next or the "
          "previous frame, for a static scene (default: by the plate's vectors)")
      ->option_text("next|previous")
      ->check(CLI::IsMember({"next", "previous"}));
  composite
      .add_option("--overscan", a.composite.overscan,
                  "Also write N pixels beyond each side of the picture, as far as all buffers have "
                  "them (default: 0)")
      ->option_text("N")
      ->check(whole_number_in(0, OutputChoice::kMaxOverscan));

  CLI::App& water =
      *app.add_subcommand("water", "Render a scene and put water into it: SCENE.toml -o OUT.exr");
  add_render(water, a.render);
  water
      .add_option("--samples", a.render.samples,
                  "N x N samples per pixel, filtered after compositing (default: 1)")
      ->option_text("N")
      ->check(whole_number_in(1, kMaxSamples));
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
      *app.add_subcommand("plan", "Print which operators run for a plate and a look, and why");
  add_composite(plan, a.composite);
  add_runner(plan, a.composite.water);
  plan.add_flag("--measure", a.composite.measure, "Also run the plan and time each operator");

  add_view(app, a.view);

  CLI::App& inspect =
      *app.add_subcommand("inspect", "Print the layers of plates, and which buffers they feed");
  add_plates(inspect, a.inspect.plates, a.inspect.scene, a.inspect.layers, a.inspect.view);

  CLI::App& operators = *app.add_subcommand("operators", "Print the chain and its parameters");
  CLI::Option* name =
      operators.add_option("name", a.operators.name, "One operator")->option_text("NAME");
  CLI::Option* look = operators.add_option("--look", a.operators.look, "Show the values of a look")
                          ->option_text("NAME|FILE");
  CLI::Option* scene =
      operators.add_flag("--scene", a.operators.scene, "Print the keys of scene files")
          ->excludes(name)
          ->excludes(look);
  CLI::Option* layers =
      operators.add_flag("--layers", a.operators.layers, "Print the rules for names of layers")
          ->excludes(name)
          ->excludes(look)
          ->excludes(scene);
  operators.add_flag("--aovs", a.operators.aovs, "Print the AOVs")
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
