#pragma once
#include <bit>
#include <cstdint>

#include "catena/core/sphere.h"

/// The x, y, z and radius of a sphere side by side, as every machine has vectors of that size: left to itself
/// the compiler takes one number after the other.
namespace catena::sphere_vector {

/// Four numbers in binary32: x, y, z and radius, or what is made of them place by place.
typedef float Four __attribute__((vector_size(16)));
/// As many whole numbers: the bits of a Four.
typedef std::int32_t Bits __attribute__((vector_size(16)));

/// A sphere as it is stored: x, y, z, radius.
inline Four four(const Sphere& s) { return std::bit_cast<Four>(s); }
/// The bits of the magnitudes: as whole numbers in the order of what they stand for, those of what is not
/// finite from `not_finite` on.
inline Bits magnitude_bits(Four value) { return std::bit_cast<Bits>(value) & 0x7FFFFFFF; }
/// Each number without its sign.
inline Four magnitude(Four value) { return std::bit_cast<Four>(magnitude_bits(value)); }
/// The bits of infinity; those of NaNs are greater.
constexpr std::int32_t not_finite = 0x7F800000;

}  // namespace catena::sphere_vector
