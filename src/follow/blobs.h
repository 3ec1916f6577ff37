/* blobs.h - what is not still in a frame: connected spots, and how much of a spot's pixels is bead.
 *
 *   frame - gain x still  --> mask (more than a threshold)  --> spots --> cover: 0 to 1 for each pixel
 *                                                                          holes filled, summed to a centroid
 *
 * The cover of a pixel is how far its level is from the background, over how far a bead's level is: a pixel on
 * the outline is covered in part, and a moving bead covers the pixels on its way in part of the exposure.  The
 * sum of the cover is then the area of the bead, however it is blurred, and the centroid is its mean place.
 */
#ifndef FST_FOLLOW_BLOBS_H
#define FST_FOLLOW_BLOBS_H

#include "follow/still.h"

/* How the bead differs from the background. */
typedef struct follow_look {
    double sign;      /* 1: darker than the background; -1: brighter */
    double contrast;  /* by which part of the background's level it is darker, or by how many levels brighter */
    double threshold; /* gray levels; less is noise */
    double levels;    /* gray levels by which it differs from the background, in the mean */
    double area;      /* of the bead, pixels */
    double diameter;  /* pixels */
    double shade;     /* part of the background's level that its shadow takes away; contrast and threshold are
                         then of what the shadow leaves */
    double shift[2];  /* pixels from the centroid of what is left to the bead's centre; 0 without a shadow */
    double diameter_error; /* pixels, a standard deviation */
} follow_look;

/* A connected spot of the mask. */
typedef struct follow_box {
    int left, right, top, bottom; /* its first and last columns and rows */
    int label, pixels;
    double sum; /* of the differences, gray levels */
} follow_box;

/* The cover of a spot, summed. */
typedef struct follow_cover {
    double area, column, row; /* pixels; the centroid */
    double narrow; /* diameter of a disc that has the same second moment, across the motion, pixels */
    int cut;       /* the spot touches the edge of the picture */
} follow_cover;

enum { FOLLOW_MOST_BOXES = 200 };

typedef struct follow_blobs {
    const follow_still *still;
    unsigned char *mask;
    int *stack;
    float *cover; /* room for the window around a spot, and what its filling needs */
    int *links;
    size_t window;
    follow_box boxes[FOLLOW_MOST_BOXES];
    int count; /* of the spots that were found; more of them have no box */
} follow_blobs;

fst_status follow_blobs_begin(follow_blobs *blobs, const follow_still *still, fst_error *error);
void follow_blobs_end(follow_blobs *blobs);

/* Find the spots of a frame (its rows are `gains` times as bright as the still picture) that differ by
 * `threshold` in the direction of `sign`. */
void follow_blobs_find(follow_blobs *blobs, const unsigned char *frame, const float *gains, double sign,
                       double threshold);

/* The cover of a spot that was found.  FST_NO_MEMORY. */
fst_status follow_blobs_cover(follow_blobs *blobs, const unsigned char *frame, const float *gains,
                              const follow_look *look, const follow_box *box, follow_cover *cover,
                              fst_error *error);

/* The first and last columns and rows of the window around a spot, and what a pixel of it adds to the spot's cover, until
 * another spot's cover is asked for. */
void follow_blobs_window(const follow_blobs *blobs, const follow_box *box, int window[4]);
double follow_blobs_part(const follow_blobs *blobs, const follow_box *box, const int window[4], int column,
                         int row);

#endif
