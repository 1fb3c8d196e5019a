#include "scene.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace {

std::string read_all(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

Mesh read_ply(const std::string& file) {
    const std::string data = read_all(file);
    const std::string end = "end_header\n";
    const std::size_t header = data.find(end);
    if (header == std::string::npos) throw std::runtime_error(file + ": is not a PLY file");
    std::istringstream words(data.substr(0, header));
    std::size_t vertices = 0, faces = 0;
    for (std::string word, kind; words >> word;) {
        if (word != "element") continue;
        words >> kind;
        words >> (kind == "vertex" ? vertices : faces);
    }
    constexpr std::size_t VERTEX = 12, FACE = 13;
    const std::size_t begin = header + end.size();
    if (data.size() != begin + VERTEX * vertices + FACE * faces)
        throw std::runtime_error(file + ": has another layout than lamina_bench/leaf.py writes");
    Mesh mesh;
    mesh.positions.resize(vertices);
    std::memcpy(mesh.positions.data(), data.data() + begin, VERTEX * vertices);
    mesh.corners.resize(3 * faces);
    const char* face = data.data() + begin + VERTEX * vertices;
    for (std::size_t i = 0; i < faces; ++i, face += FACE)
        std::memcpy(&mesh.corners[3 * i], face + 1, 12);
    return mesh;
}

std::vector<Placement> read_placements(const std::string& file) {
    const std::string data = read_all(file);
    std::vector<Placement> placements(data.size() / sizeof(Placement));
    if (placements.empty() || data.size() % sizeof(Placement) != 0)
        throw std::runtime_error(file + ": does not hold whole 3 x 4 matrices");
    std::memcpy(placements.data(), data.data(), data.size());
    return placements;
}

Facts read_facts(const std::string& file) {
    std::istringstream lines(read_all(file));
    Facts facts;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        if (!(words >> name)) continue;
        for (float value; words >> value;) facts[name].push_back(value);
    }
    return facts;
}

const std::vector<float>& numbers(const Facts& facts, const std::string& name, std::size_t count) {
    const auto found = facts.find(name);
    if (found == facts.end() || found->second.size() != count)
        throw std::runtime_error("scene.txt: `" + name + "` needs " + std::to_string(count) +
                                 " numbers");
    return found->second;
}

Vec vector(const Facts& facts, const std::string& name) {
    const auto& values = numbers(facts, name, 3);
    return {values[0], values[1], values[2]};
}

World::World(const std::string& leaf_ply, const std::string& placements, bool robust)
    : device_(rtcNewDevice(nullptr)), scene_(nullptr) {
    if (!device_) throw std::runtime_error("Embree gives no device");
    const auto version = rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_VERSION);
    if (version / 10000 != 4)
        throw std::runtime_error("Embree's version is " + std::to_string(version) + ", not 4");
    scene_ = rtcNewScene(device_);
    const int flags = robust ? RTC_SCENE_FLAG_ROBUST : 0;
    rtcSetSceneFlags(scene_, flags);
    Mesh leaf = read_ply(leaf_ply);
    placements_ = placements.empty() ? std::vector<Placement>{} : read_placements(placements);
    if (placements_.size() <= 1) {
        if (!placements_.empty())
            for (Vec& p : leaf.positions) p = placements_[0].point(p);
        add(leaf, Surface::leaf);
        return;
    }
    leaf_scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(leaf_scene_, flags);
    attach(leaf_scene_, leaf);
    rtcCommitScene(leaf_scene_);
    for (const Placement& placement : placements_) {
        RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, leaf_scene_);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, placement.m);
        rtcCommitGeometry(instance);
        rtcAttachGeometry(scene_, instance);
        rtcReleaseGeometry(instance);
        surfaces_.push_back(Surface::leaf);
    }
    check("the leaves");
}

World::~World() {
    rtcReleaseScene(scene_);
    if (leaf_scene_) rtcReleaseScene(leaf_scene_);
    rtcReleaseDevice(device_);
}

void World::add(const Mesh& mesh, Surface surface) {
    // Geometry is numbered in the order in which it is attached.
    if (attach(scene_, mesh) != surfaces_.size())
        throw std::runtime_error("Embree numbers geometry in another order");
    surfaces_.push_back(surface);
    check("a mesh");
}

void World::commit() {
    rtcCommitScene(scene_);
    check("the scene");
}

unsigned World::attach(RTCScene scene, const Mesh& mesh) const {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t faces = mesh.corners.size() / 3;
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                              RTC_FORMAT_FLOAT3, 12, mesh.positions.size());
    void* corners =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, faces);
    if (!positions || !corners) throw std::runtime_error("Embree gives no buffer for a mesh");
    std::memcpy(positions, mesh.positions.data(), 12 * mesh.positions.size());
    std::memcpy(corners, mesh.corners.data(), 12 * faces);
    rtcCommitGeometry(geometry);
    const unsigned number = rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    return number;
}

void World::check(const char* what) const {
    if (const int error = rtcGetDeviceError(device_))
        throw std::runtime_error(std::string("Embree's error ") + std::to_string(error) + " at " +
                                 what);
}

Surface World::surface(const RTCHit& hit) const {
    return hit.instID[0] != RTC_INVALID_GEOMETRY_ID ? Surface::leaf : surfaces_[hit.geomID];
}

Vec World::normal(const RTCHit& hit) const {
    const Vec local = normalised({hit.Ng_x, hit.Ng_y, hit.Ng_z});
    if (hit.instID[0] == RTC_INVALID_GEOMETRY_ID) return local;
    return placements_[hit.instID[0]].direction(local);
}
