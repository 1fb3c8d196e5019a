// The part of Embree 4's C interface that is used here, declared anew: the library comes from the
// Python wheel `embreex`, which has no headers. Names, layouts and numbers are those of Embree 4.4's
// documentation (https://github.com/RenderKit/embree, Apache-2.0); `version` in main.cpp refuses
// any other major version.
#pragma once

#include <cstddef>
#include <cstdint>
#include <sys/types.h>

extern "C" {

using RTCDevice = struct RTCDeviceTy*;
using RTCScene = struct RTCSceneTy*;
using RTCGeometry = struct RTCGeometryTy*;

enum : int {
    RTC_DEVICE_PROPERTY_VERSION = 0,
    RTC_GEOMETRY_TYPE_TRIANGLE = 0,
    RTC_GEOMETRY_TYPE_INSTANCE = 121,
    RTC_BUFFER_TYPE_INDEX = 0,
    RTC_BUFFER_TYPE_VERTEX = 1,
    RTC_FORMAT_UINT3 = 0x5003,
    RTC_FORMAT_FLOAT3 = 0x9003,
    RTC_FORMAT_FLOAT3X4_ROW_MAJOR = 0x9134,
    RTC_SCENE_FLAG_ROBUST = 1 << 2,
};
constexpr std::uint32_t RTC_INVALID_GEOMETRY_ID = ~0u;

struct alignas(16) RTCRay {
    float org_x, org_y, org_z, tnear;
    float dir_x, dir_y, dir_z, time;
    float tfar;
    std::uint32_t mask, id, flags;
};

struct alignas(16) RTCHit {
    float Ng_x, Ng_y, Ng_z, u, v;
    std::uint32_t primID, geomID, instID[1], instPrimID[1];
};

struct RTCRayHit {
    RTCRay ray;
    RTCHit hit;
};

RTCDevice rtcNewDevice(const char* config);
void rtcReleaseDevice(RTCDevice device);
ssize_t rtcGetDeviceProperty(RTCDevice device, int property);
int rtcGetDeviceError(RTCDevice device);

RTCGeometry rtcNewGeometry(RTCDevice device, int type);
void* rtcSetNewGeometryBuffer(RTCGeometry geometry, int type, unsigned slot, int format,
                              std::size_t stride, std::size_t count);
void rtcSetGeometryInstancedScene(RTCGeometry geometry, RTCScene scene);
void rtcSetGeometryTransform(RTCGeometry geometry, unsigned time_step, int format,
                             const void* matrix);
void rtcCommitGeometry(RTCGeometry geometry);
void rtcReleaseGeometry(RTCGeometry geometry);

RTCScene rtcNewScene(RTCDevice device);
void rtcSetSceneFlags(RTCScene scene, int flags);
unsigned rtcAttachGeometry(RTCScene scene, RTCGeometry geometry);
void rtcCommitScene(RTCScene scene);
void rtcReleaseScene(RTCScene scene);
// The last argument may be null: nothing special is asked for.
void rtcIntersect1(RTCScene scene, RTCRayHit* ray_hit, void* arguments);
void rtcOccluded1(RTCScene scene, RTCRay* ray, void* arguments);
}
