/* constants.h - mathematical constants. */
#ifndef FST_BASE_CONSTANTS_H
#define FST_BASE_CONSTANTS_H

#define FST_PI 3.141592653589793238462643
#define FST_TWO_PI 6.283185307179586476925287
#define FST_DEGREES 57.29577951308232087680 /* degrees in a radian */
#define FST_MU_0 1.25663706127e-6           /* magnetic constant, T m/A (CODATA 2022) */

#endif
