/* constants.h - pi, and what a radian is in degrees. */
#ifndef FST_BASE_CONSTANTS_H
#define FST_BASE_CONSTANTS_H

#define FST_PI 3.14159265358979323846
#define FST_TWO_PI 6.283185307179586476925287
#define FST_DEGREES 57.29577951308232087680 /* in a radian */

#endif
