#include "judge/trace/triangles.h"

#include <algorithm>

#include <embree3/rtcore.h>

#include "limpid/core/error.h"

namespace limpid::trace {
namespace {

/// Context of a search after Embree's own, which must come first.
struct Query {
  RTCIntersectContext context;
  const Triangles* triangles;
  const PointTest* test;
  Sides sides;
  glm::dvec3 direction;
};

const Query& query_of(const RTCFilterFunctionNArguments* arguments) {
  return *reinterpret_cast<const Query*>(arguments->context);
}

/// Embree calls this for every triangle that a ray meets.
void ignore_hidden_side(const RTCFilterFunctionNArguments* arguments) {
  const Query& query = query_of(arguments);
  const std::uint32_t part = RTCHitN_geomID(arguments->hit, arguments->N, 0);
  const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
  if (query.sides == Sides::kShown && query.triangles->parts()[part].back_shown) return;
  const bool back = glm::dot(query.triangles->corners(part, triangle).cross(), query.direction) > 0;
  if (back != (query.sides == Sides::kBack)) arguments->valid[0] = 0;
}

/// And this for every tested triangle.
void ignore_holes(const RTCFilterFunctionNArguments* arguments) {
  const Query& query = query_of(arguments);
  if (!query.test) return;
  const unsigned n = arguments->N;
  const double b = RTCHitN_u(arguments->hit, n, 0), c = RTCHitN_v(arguments->hit, n, 0);
  const bool there = query.test->there(RTCHitN_geomID(arguments->hit, n, 0),
                                       RTCHitN_primID(arguments->hit, n, 0), {1 - b - c, b, c});
  if (!there) arguments->valid[0] = 0;
}

void ignore_hidden_side_and_holes(const RTCFilterFunctionNArguments* arguments) {
  ignore_hidden_side(arguments);
  if (arguments->valid[0] != 0) ignore_holes(arguments);
}

RTCRay ray_of(const Ray& ray) {
  RTCRay r{};
  r.org_x = static_cast<float>(ray.origin.x);
  r.org_y = static_cast<float>(ray.origin.y);
  r.org_z = static_cast<float>(ray.origin.z);
  r.dir_x = static_cast<float>(ray.direction.x);
  r.dir_y = static_cast<float>(ray.direction.y);
  r.dir_z = static_cast<float>(ray.direction.z);
  r.tnear = static_cast<float>(ray.from);
  r.tfar = static_cast<float>(ray.to);
  r.mask = ~0u;
  return r;
}

void expect_no_error(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw no_memory("the triangles to trace");
  }
  throw Error("Embree cannot trace here: its error " + std::to_string(error));
}

}  // namespace

struct Triangles::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  void add(const Part& part) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), part.positions.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), part.indices.size() / 3));
    if (positions && indices) {
      for (const glm::dvec3& p : part.positions) {
        for (int c = 0; c < 3; ++c) *positions++ = static_cast<float>(p[c]);
      }
      std::copy(part.indices.begin(), part.indices.end(), indices);
      rtcSetGeometryIntersectFilterFunction(
          geometry, part.tested ? ignore_hidden_side_and_holes : ignore_hidden_side);
      if (part.tested) rtcSetGeometryOccludedFilterFunction(geometry, ignore_holes);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry);
    expect_no_error(device);
  }
};

Triangles::Triangles(std::vector<Part> parts)
    : parts_(std::move(parts)), state_(std::make_unique<State>()) {
  state_->device = rtcNewDevice(nullptr);
  if (!state_->device) expect_no_error(nullptr);
  state_->scene = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
  for (const Part& part : parts_) state_->add(part);
  rtcCommitScene(state_->scene);
  expect_no_error(state_->device);
}

Triangles::~Triangles() = default;

Triangles::Corners Triangles::corners(std::uint32_t part, std::uint32_t triangle) const {
  const Part& p = parts_[part];
  const std::uint32_t* corner = p.indices.data() + 3 * std::size_t{triangle};
  return {p.positions[corner[0]], p.positions[corner[1]], p.positions[corner[2]]};
}

std::optional<Triangles::Hit> Triangles::nearest(const Ray& ray, Sides sides,
                                                 const PointTest* test) const {
  if (empty()) return std::nullopt;
  Query query{{}, this, test, sides, ray.direction};
  rtcInitIntersectContext(&query.context);
  RTCRayHit found{ray_of(ray), {}};
  found.hit.geomID = found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &query.context, &found);
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  Hit hit;
  hit.part = found.hit.geomID;
  hit.triangle = found.hit.primID;
  const Corners at = corners(hit.part, hit.triangle);
  hit.front = glm::normalize(at.cross());
  double largest = 0;
  for (const glm::dvec3& p : {at.a, at.b, at.c, ray.origin}) {
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(p[c]));
  }
  hit.slack = 4e-7 * largest;
  const double exact = distance_to_plane(ray, at.a, hit.front);
  // The plane of a triangle seen edge-on is badly conditioned.
  const double coarse = found.ray.tfar, off = 1e-3 * coarse + 16 * hit.slack;
  hit.distance = std::abs(exact - coarse) <= off ? std::max(exact, ray.from) : coarse;
  hit.point = ray.at(hit.distance);
  return hit;
}

bool Triangles::block(const Ray& ray, const PointTest* test) const {
  if (empty()) return false;
  Query query{{}, this, test, Sides::kShown, ray.direction};
  rtcInitIntersectContext(&query.context);
  RTCRay r = ray_of(ray);
  rtcOccluded1(state_->scene, &query.context, &r);
  return r.tfar < 0;
}

std::vector<std::uint32_t> with_area(const std::vector<glm::dvec3>& positions,
                                     std::span<const std::uint32_t> indices) {
  std::vector<std::uint32_t> kept;
  kept.reserve(indices.size());
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const auto triangle = indices.subspan(i, 3);
    const glm::dvec3 cross =
        Triangles::Corners{positions[triangle[0]], positions[triangle[1]], positions[triangle[2]]}
            .cross();
    if (glm::dot(cross, cross) > 0) kept.insert(kept.end(), triangle.begin(), triangle.end());
  }
  return kept;
}

glm::dvec3 corner_shares(const Triangles::Corners& corners, const glm::dvec3& point) {
  const glm::dvec3 whole = corners.cross();
  const double square = glm::dot(whole, whole);
  const double b = glm::dot(glm::cross(point - corners.a, corners.c - corners.a), whole) / square;
  const double c = glm::dot(glm::cross(corners.b - corners.a, point - corners.a), whole) / square;
  return {1 - b - c, b, c};
}

}  // namespace limpid::trace
