#pragma once

// Stands in front of the compiler's own header where Eigen includes that one. Eigen fuses multiply-adds where
// this macro is there, which would change the last bits of maps. The compiler's header defines it anew, so -U
// does not reach Eigen.
#include_next <arm_neon.h>
#undef __ARM_FEATURE_FMA
