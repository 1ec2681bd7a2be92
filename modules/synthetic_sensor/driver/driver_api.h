#pragma once

// OpenNI2's header for drivers, and what it expects to be defined.
#define XN_NEW(type, argument) new type(argument)
#define XN_DELETE(pointer) delete pointer
#include <Driver/OniDriverAPI.h>

#include <cstring>

namespace declutter {

// Copies a property as OpenNI2 hands them over.
template <typename T>
OniStatus GetProperty(const T& value, void* data, int* size) {
  if (*size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(T));
  return ONI_STATUS_OK;
}
template <typename T>
OniStatus SetProperty(const void* data, int size, T* value) {
  if (size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(value, data, sizeof(T));
  return ONI_STATUS_OK;
}

}  // namespace declutter
