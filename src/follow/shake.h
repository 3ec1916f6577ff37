/* shake.h - a camera that shakes: by how many pixels a frame is shifted, told by the background, and the frame
 * shifted back. */
#ifndef FST_FOLLOW_SHAKE_H
#define FST_FOLLOW_SHAKE_H

enum { FOLLOW_SHAKE_LEVELS = 4 };

/* A picture and its halves, quarters and eighths, and room for those of a frame. */
typedef struct follow_shake {
    int margin; /* pixels all around that are not compared */
    int half;   /* 0: all pixels; 1, 2: those of the white, of the black fields of a chequerboard */
    int count, width[FOLLOW_SHAKE_LEVELS], height[FOLLOW_SHAKE_LEVELS];
    float *picture[FOLLOW_SHAKE_LEVELS], *frame[FOLLOW_SHAKE_LEVELS];
} follow_shake;

/* Take the picture with which frames are compared, but for a margin; 0: no memory.  Free with follow_shake_end(). */
int follow_shake_begin(follow_shake *shake, const float *level, int width, int height, int margin);
void follow_shake_end(follow_shake *shake);

/* By how many columns and rows a frame, whose rows are `gains` times as bright as the picture, is shifted against
 * it; `shift` holds a guess.  Returns how much of the picture's gradient the frame has there: 1 where the shift is
 * right, about 0 where it is wrong, or the picture is blurred; NAN, with the guess left, where it is too plain. */
double follow_shake_find(follow_shake *shake, const unsigned char *frame, const float *gains, double shift[2]);

/* By which angle (rad, clockwise as the picture is seen) the frame of the last search is turned about its middle, beside that
 * shift; NAN: the picture is too plain to tell, or the angle too large. */
double follow_shake_roll(const follow_shake *shake, const double shift[2]);

/* The mean square of both components of that shift (pixels), and the square of that angle, each a product of what the two
 * halves of a chequerboard tell apart from each other.  Noise, and what compression makes of it, differs between them:
 * over many frames of a camera that stands still the products cancel, where squares would add up to a false shake. */
void follow_shake_squares(follow_shake *shake, const double shift[2], double *moved, double *turned);

/* Shift the frame of the last search back, by straight lines between pixels.  What comes from outside of it, and
 * the margin, are taken from the picture. */
void follow_shake_undo(const follow_shake *shake, const float *gains, const double shift[2],
                       unsigned char *frame);

#endif
