/* lab.h - one bead, or several, on the page: what lab.c and recorded.c share. */
#ifndef FST_LAB_H
#define FST_LAB_H

#include <stdlib.h>
#include <string.h>

#include <festoon/bead_files.h>
#include <festoon/beads.h>
#include <festoon/festoon.h>

#define EXPORT(name) __attribute__((export_name(#name)))

/* The page is told how far a run is; what it answers other than 0 ends the run. */
__attribute__((import_module("lab"), import_name("tell"))) int lab_tell(double fraction);

/* The columns of a row of the motion; src/core.js has the same names in the same order. */
enum {
    COLUMN_TIME, /* s, since the motion began */
    COLUMN_TURNS,
    COLUMN_OMEGA,
    COLUMN_X, /* in the laboratory, l */
    COLUMN_Y,
    COLUMN_R,
    COLUMN_PHI, /* Phi, unwrapped, rad */
    COLUMN_ALPHA,
    COLUMN_N,            /* moment, in the laboratory, 3 */
    COLUMN_B = 11,       /* field, in the laboratory, 3 */
    COLUMN_N_LOCAL = 14, /* moment along r, alpha, z */
    COLUMN_FIELD = 17,
    COLUMN_ANGLE,
    COLUMN_SLIP, /* along r and alpha, 2 */
    COLUMN_SLIP_SIZE = 21,
    COLUMN_SPIN,
    COLUMN_LOAD, /* in weights of the bead */
    COLUMN_ENERGY,
    COLUMN_FRICTION, /* size of the friction force, weights */
    COLUMN_FRICTION_USE,
    COLUMN_STICKS,
    COLUMN_SPEED,
    COLUMN_FORCE,     /* friction force on the bead, in the laboratory, weights, 2 */
    COLUMN_TURN = 31, /* quaternion of the bead, x y z w */
    COLUMN_Z = 35,    /* height of the centre over the plate, or over where one would be, l */
    COLUMN_MAGNET,    /* turns of the magnet; COLUMN_TURNS counts periods of the drive */
    COLUMN_TOUCHES,   /* the sum of 2^i over the beads i that it touches */
    COLUMNS
};

enum { ROWS = 4096, TEXT_SIZE = 512 };

/* A map that was given to the page, by its name and checksum. */
typedef struct lab_kept_map {
    fst_field_map *map;
    char name[256], checksum[17];
} lab_kept_map;

typedef struct lab {
    fst_params params, kept;
    lab_kept_map maps[2], *latest;
    fst_error error;
    fst_run_result result;
    fst_world_result world; /* of the last run of a bead in a world */
    fst_beads_result beads; /* of the last run of several */
    fst_model *model;       /* of the motion that is shown, with its flow; NULL: none */
    fst_flow *flow;
    fst_grid *grid;
    double time_unit, length_unit;
    double seconds, turns, phi; /* where the motion stood when this flow began */
    double turn[4];             /* quaternion of the bead, laboratory <- bead */
    double w_before[3];         /* angular velocity at the last row, in the laboratory */
    double before;              /* flow time of the last row */
    double numbers[16];
    char text[TEXT_SIZE];
    double rows[ROWS][COLUMNS];
} lab;

/* Whether the motion is that of several beads or of one in a world, which is computed whole and recorded. */
int lab_is_recorded(const lab *l);

/* Where the scene names a map, the parameters use it; what the page does not have is an error. */
fst_status lab_lend_map(lab *l);

/* What recorded.c has of lab_check() and lab_run(). */
fst_status lab_check_recorded(lab *l);
fst_status lab_run_recorded(lab *l, const fst_progress *progress);

/* The bead turns by the vector `by`, in the laboratory, and then its axis, which is z of the bead, points to n. */
void lab_turn(double turn[4], const double by[3], const double n[3]);

#endif
