/* festoon.h - a magnetic bead on a spinning magnet: model, integration, observables.
 *
 * The library follows Farago, Charitat, Bigot, Schotter and Kulic, "Counter-rotation of magnetic beads in
 * spinning fields", Phys.  Rev.  E 102, 042201 (arXiv:2003.10782).  "The paper" in these comments is this one;
 * figures, equations and sections have its printed numbers.
 *
 * Units.  Unless a name says otherwise, lengths are in l (half length of the magnet's lines), times in 1/gamma
 * (gamma: friction rate), fields in B0, masses in the bead's mass.
 *
 * A state is ten doubles, FST_STATE_SIZE: X Y vX vY nX nY nZ WX WY WZ.  These are the bead's position,
 * velocity, direction n of the moment, and angular velocity W.  All are vectors of the laboratory (inertial),
 * but written in components along axes that turn with the magnet, X along its lines.
 *
 * The library never prints, exits, or keeps global variables.  A function that can fail returns an fst_status
 * and, if the caller passes an fst_error, fills in a sentence: what, where, what to try.  Models are immutable
 * and may be shared by threads; an fst_flow belongs to one thread.
 */
#ifndef FESTOON_FESTOON_H
#define FESTOON_FESTOON_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include <festoon/lists.def>
#include <festoon/physics.def>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define FST_API __attribute__((visibility("default")))
#else
#define FST_API
#endif

/* ------------------------------------------------------------------ version, status, errors */

#define FST_VERSION_MAJOR 0
#define FST_VERSION_MINOR 1
#define FST_VERSION_PATCH 0
#define FST_VERSION_STRING "0.1.0"

/* Increased when the same parameters give other bits than before: the first is the version of the laws viscous
 * and none, the second that of dry friction (coulomb, rolling).  A sweep that was begun by another version is
 * not continued. */
#define FST_RESULTS_VERSION 15
#define FST_DRY_RESULTS_VERSION 19

/* "0.1.0": the version of the library that is running. */
FST_API const char *fst_version(void);

/* The status that a function returns.  The texts are those of fst_status_text(). */
#define FST_STATUS_LIST(X)                                                                                     \
    X(FST_OK, "done")                                                                                          \
    X(FST_BAD_INPUT, "bad input")                                                                              \
    X(FST_STEP_UNDERFLOW, "the step size underflowed")                                                         \
    X(FST_NOT_FINITE, "a number stopped being finite")                                                         \
    X(FST_NO_CONVERGENCE, "no convergence")                                                                    \
    X(FST_IO, "input or output failed")                                                                        \
    X(FST_NO_MEMORY, "out of memory")                                                                          \
    X(FST_UNAVAILABLE, "this build lacks a component")                                                         \
    X(FST_INTERRUPTED, "interrupted")
typedef enum fst_status {
#define FST_STATUS_ENUM(name, text) name,
    FST_STATUS_LIST(FST_STATUS_ENUM) FST_STATUS_COUNT
#undef FST_STATUS_ENUM
} fst_status;

/* The text of a status, for people; never NULL. */
FST_API const char *fst_status_text(fst_status status);

/* An error, owned by the caller.  `where` names a function, a file and line, or a time. */
typedef struct fst_error {
    fst_status code;
    char where[256];
    char sentence[768];
} fst_error;

/* ------------------------------------------------------------------ progress and cancellation */

/* Every call that may last longer than a tenth of a second takes one of these (NULL: the call says nothing and
 * runs to its end).  The call tells how much of its work is done, `fraction` from 0 to 1, which never falls,
 * and in `what` which part it is at (NULL where the work has no parts that a person would tell apart).  FST_OK
 * lets it go on.  Any other status ends the call with that status and with the error that tell() filled in,
 * which is never NULL; tell() is then not called again.  tell() runs in the thread that made the call. */
typedef struct fst_progress {
    void *user;
    fst_status (*tell)(void *user, double fraction, const char *what, fst_error *error);
} fst_progress;

/* ------------------------------------------------------------------ parameters */

/* An enum made by FST_ROW_ENUM has an enumerator for each row of a list of lists.def (FST_MATERIAL_HARD, ...),
 * and behind them the number of rows. */
typedef enum { FST_MATERIALS(FST_ROW_ENUM) FST_MATERIAL_COUNT } fst_material;
/* A number for each row of physics.def: FST_MAGNET_LINES, ...; FST_FRICTION_VISCOUS, FST_FRICTION_NONE, ... */
#define FST_SOURCE_ENUM(NAME, name, doc) FST_MAGNET_##NAME,
#define FST_CONTACT_ENUM(NAME, name, modes, brakes, doc) FST_FRICTION_##NAME,
typedef enum { FST_SOURCES(FST_SOURCE_ENUM) FST_MAGNET_SHAPES } fst_magnet_shape;
typedef enum { FST_CONTACTS(FST_CONTACT_ENUM) FST_FRICTION_LAWS } fst_friction_law;
#undef FST_SOURCE_ENUM
#undef FST_CONTACT_ENUM
typedef enum { FST_DYNAMICS(FST_ROW_ENUM) FST_DYNAMICS_COUNT } fst_dynamics;
typedef enum { FST_PATCHES(FST_ROW_ENUM) FST_PATCH_COUNT } fst_contact_patch;
typedef enum { FST_SPINS(FST_ROW_ENUM) FST_SPIN_COUNT } fst_start_spin;
typedef enum { FST_UNTILS(FST_ROW_ENUM) FST_UNTIL_COUNT } fst_run_until;
typedef enum { FST_BEADS_METHODS(FST_ROW_ENUM) FST_BEADS_METHOD_COUNT } fst_beads_method;
typedef enum { FST_PLATE_SHAPES(FST_ROW_ENUM) FST_PLATE_SHAPE_COUNT } fst_plate_shape;
typedef enum { FST_PART_MOTIONS(FST_ROW_ENUM) FST_PART_MOTION_COUNT } fst_part_motion;
typedef enum { FST_WAVEFORMS(FST_ROW_ENUM) FST_WAVEFORM_COUNT } fst_drive_waveform;
typedef enum { FST_FRAMES(FST_ROW_ENUM) FST_FRAME_COUNT } fst_frame;

/* The kinds of unit that a value may carry. */
typedef enum { FST_UNITS(FST_ROW_ENUM) FST_UNIT_COUNT } fst_unit;

/* A part of a real magnet (magnet.shape: parts), uniformly magnetised, in SI units.  The magnet's frame has its
 * origin on the axis of rotation at the magnet's reference plane, which lies magnet.depth below the plate; z
 * points up.  Remanence and moment are vectors of the part's own axes, and turn with it. */
typedef enum { FST_PARTS(FST_ROW_ENUM) FST_PART_KINDS } fst_part_kind;
typedef struct fst_magnet_part {
    int kind;         /* fst_part_kind */
    double centre[3]; /* m, in the magnet's frame */
    double size[3];   /* m: edges of a cuboid; diameter and height (along the own z) of a cylinder; diameter */
    double remanence[3]; /* T; not of a dipole */
    double moment[3];    /* A m^2; of a dipole */
    double rotation[4];  /* degrees about the axis (x, y, z) that follows, through the centre */
    int motion;          /* fst_part_motion */
} fst_magnet_part;

enum { FST_PARTS_MAX = 16 };

/* A circular coil that stands still in the laboratory, whose axes are the magnet's at the time 0; its current is
 * current + ac cos(2 pi frequency t + phase), anticlockwise seen from where the axis points to. */
typedef struct fst_coil {
    double radius, centre[3]; /* m */
    double axis[3];
    double turns, current, ac; /* A */
    double frequency, phase;   /* Hz, degrees */
} fst_coil;

enum { FST_COILS_MAX = 8 };

typedef struct fst_field_map fst_field_map; /* of magnet.shape: grid (field_maps.h) */

/* What a bead of the list `beads` says of its own: the keys of bead.* and start.*.  Where it says nothing (NAN; -1 of
 * a choice), those of the whole setup hold. */
typedef struct fst_bead_params {
#define FST_KEYS_OF_A_BEAD
#define FST_REAL(group, name, unit, initial, least, greatest, doc) double group##_##name;
#define FST_CHOICE(group, name, names, initial, doc) int group##_##name;
#define FST_REALS3(group, name, unit, initial, least, greatest, doc) double group##_##name[3];
#include <festoon/params.def>
#undef FST_REALS3
#undef FST_REAL
#undef FST_CHOICE
#undef FST_KEYS_OF_A_BEAD
} fst_bead_params;

/* The exact method takes FST_BEADS_MOST beads, which have keys; time stepping takes FST_BEADS_MANY. */
enum { FST_BEADS_MOST = 8, FST_BEADS_MANY = 1000 };

/* The library's own in fst_params: which of several forms of a quantity (fst_param_other_form()) was given. */
enum { FST_FORMS = 18 };
typedef struct fst_params_notes {
    double seen[FST_FORMS]; /* what the fields of the forms held when the library last looked */
    int kappa_given;        /* whether model.kappa was given, also with the value that is its default */
    int bare; /* the parameter last set by a bare number that is unlikely, from 1 on; 0: there is none */
} fst_params_notes;
/* The default of run.rtol, and of the tolerances of a flow. */
#define FST_DEFAULT_RTOL 1e-10

/* A setup in SI units: what a scene says.  Get one from fst_default_params(), change fields, and make a model
 * of it.  A field that is NAN was not given and follows from others; params.def says how.
 *
 * Some quantities have two forms, as drive.omega and drive.frequency.  A field that is given another number
 * than it holds counts as fst_params_set() would: it takes the place of the other forms, which then have no
 * effect and are not written into scenes.  Writing the number that is there already says nothing;
 * fst_params_set() does then.  Where both were changed in one go, nobody knows which is meant, and making a
 * model fails with the names of both; fst_params_set() and fst_params_settle() end such a go. */
typedef struct fst_params {
    uint32_t cookie; /* set by fst_default_params(); a struct that was never initialised has another value */
#define FST_REAL(group, name, unit, initial, least, greatest, doc) double group##_##name;
#define FST_INT(group, name, initial, least, greatest, doc) int group##_##name;
#define FST_CHOICE(group, name, names, initial, doc) int group##_##name;
#define FST_TEXT(group, name, room, doc) char group##_##name[room];
#define FST_REALS2(group, name, unit, initial, least, greatest, doc) double group##_##name[2];
#define FST_REALS3(group, name, unit, initial, least, greatest, doc) double group##_##name[3];
#include <festoon/params.def>
#undef FST_REALS2
#undef FST_REALS3
#undef FST_REAL
#undef FST_INT
#undef FST_CHOICE
#undef FST_TEXT
    /* The map of magnet.file.  It is borrowed: it stays its owner's, who keeps it as long as these parameters,
     * or copies of them, are used. */
    const fst_field_map *magnet_map;
    int magnet_part_count; /* of magnet.shape: parts */
    fst_magnet_part magnet_parts[FST_PARTS_MAX];
    int bead_count; /* of the list `beads`; 0: there is none, but the one bead of bead.* and start.* */
    fst_bead_params beads[FST_BEADS_MOST];
    /* All beads of a list of more than FST_BEADS_MOST, which have no keys; borrowed as magnet_map is. */
    const fst_bead_params *bead_list;
    int coil_count;
    fst_coil coils[FST_COILS_MAX];
    fst_params_notes notes; /* not to be written by programs */
} fst_params;

/* How far a place in the magnet's frame is from a part, m; 0 inside it and on its surface. */
FST_API double fst_part_distance(const fst_magnet_part *part, const double place[3]);

/* Whether two parts have a volume in common, as no two bodies have; parts that touch, also as inexactly as a thousandth of
 * the thinner one's thickness, and dipoles have none. */
FST_API int fst_parts_overlap(const fst_magnet_part *one, const fst_magnet_part *other);

/* The first part that a ball of this radius about the place touches; -1 if none.  With radius 0: the part in or
 * on which the place lies, where the magnet's field is not computed. */
FST_API int fst_part_touched(const fst_params *params, const double place[3], double radius);

/* The paper's bead at 10.7 Hz with the dynamics `rigid`. */
FST_API fst_params fst_default_params(void);

typedef enum { FST_KIND_REAL, FST_KIND_INT, FST_KIND_CHOICE, FST_KIND_TEXT } fst_param_kind;

/* Room for the text of any parameter, with the zero behind it. */
enum { FST_PARAM_TEXT_SIZE = 256 };

/* One row of params.def, or of a part of the magnet. */
typedef struct fst_param_info {
    const char *key; /* "bead.radius" */
    fst_param_kind kind;
    fst_unit unit;
    const char *names;      /* of a choice, "rigid|farago2020"; otherwise NULL */
    double initial;         /* default, in SI; NAN: not given; of a choice: its index */
    double least, greatest; /* of a text: its length */
    const char *doc;
    size_t offset; /* of the field in fst_params */
} fst_param_info;

/* The number of rows of params.def, and the row `index` (NULL beyond the end).  Behind these
 * are those of the parts of a magnet, from "magnet.parts[0].kind" to the last number of part FST_PARTS_MAX - 1, then
 * the components of vectors ("start.position[0]"), the numbers of coils ("coils[0].radius", ...), and last those of the
 * first FST_BEADS_MOST beads of a list, from "beads[0].bead.radius" on. */
FST_API int fst_param_count(void);
FST_API const fst_param_info *fst_param_at(int index);

/* The number of rows that may say something of this setup; of parts that its magnet lacks fst_params_get() says
 * nothing.  Ask it where whole setups are compared or written. */
FST_API int fst_params_row_count(const fst_params *params);

/* The part of a magnet, the coil, or the bead of a list, to which a row belongs; -1: to none. */
FST_API int fst_param_part(int index);
FST_API int fst_param_coil(int index);
FST_API int fst_param_bead(int index);

/* The row index of a key, or -1.  A bead's own keys go without their group too: beads[1].radius. */
FST_API int fst_param_find(const char *key);

/* The name of the SI unit of a kind ("m", "Hz", "1" for a pure number), and the units that are accepted for it
 * ("um mm cm m"). */
FST_API const char *fst_unit_name(fst_unit unit);
FST_API const char *fst_unit_accepted(fst_unit unit);

/* The name of the unit in which people read values of a kind ("mm"), and in *power the power of ten by which a
 * value is more in it than in SI (3). */
FST_API const char *fst_unit_customary(fst_unit unit, int *power);

/* Read a value with an optional unit, "2.5 mm".  FST_BAD_INPUT: it is not a number, has a wrong unit, or something
 * follows it. */
FST_API fst_status fst_parse_value(const char *text, fst_unit unit, double *value, fst_error *error);

/* Set one parameter from text: checks key, unit and range, and clears the other form of the same quantity
 * (drive.omega and drive.frequency, model.eps and bead.radius, model.h and magnet.depth, model.lambda and
 * magnet.width, model.kappa and magnet.b0, bead.density and bead.mass, bead.remanence and bead.moment).
 * Another magnet.file takes magnet.checksum and the map away.  The key magnet.parts[N].kind of the part behind
 * the last one adds a part, any key of the bead behind the last one adds a bead.  FST_BAD_INPUT: the sentence names the nearest valid key, the units, or the range.
 */
FST_API fst_status fst_params_set(fst_params *params, const char *key, const char *text, fst_error *error);

/* Take a parameter back to what it is where nothing was said of it.  FST_BAD_INPUT: there is no such key, or it
 * is that of a part's number. */
FST_API fst_status fst_params_unset(fst_params *params, const char *key, fst_error *error);

/* Let fields that were changed since the last call take the place of the other forms of their quantities, which
 * go back to their defaults.  Every function that reads parameters does this by itself, on a copy.  It serves a
 * program that reads fields back, or that will change another form of the same quantity next.  FST_BAD_INPUT:
 * two forms of one quantity were changed; `params` is unchanged. */
FST_API fst_status fst_params_settle(fst_params *params, fst_error *error);

/* The setup of one bead of the list as if it were alone: what it says itself, and what the list's setup says.
 * FST_BAD_INPUT: there is no such bead. */
FST_API fst_status fst_params_of_bead(const fst_params *params, int bead, fst_params *alone, fst_error *error);

/* Whether two keys that are both given in this setup tell one quantity twice.  model.kappa and magnet.b0 do
 * with lines and a moment of the bead; model.kappa and the moment do beside a real magnet. */
FST_API int fst_params_clash(const fst_params *params, const char *one, const char *two);

/* Whether `after`, made of `before` by giving another key, has lost what was given for this one: model.kappa, magnet.b0 or
 * the bead's moment, of which the last given count.  0 for any other key. */
FST_API int fst_params_takes_back(const fst_params *before, const fst_params *after, const char *key);

/* The drive periods that a run leaves out of its means: run.discard; but the first half of a run that is no
 * longer than run.discard, or that run.duration measures, where that has its default of 200. */
FST_API double fst_run_discard(const fst_params *params);

/* The key by which a bead needs three dimensions (plate.shape, medium.*, a start above the plate), so that
 * fst_world_run() of beads.h simulates it; NULL: there is none. */
FST_API const char *fst_key_of_world(const fst_params *params);

/* The key by which more than a magnet that turns steadily makes the field, or another frame is asked for; NULL: there is
 * none, and nothing but the model is needed. */
FST_API const char *fst_key_of_surroundings(const fst_params *params);

/* The frame (fst_frame) in which such a bead is computed: the laboratory's, where something stands still or travels, or
 * where that is asked for; otherwise the magnet's. */
FST_API int fst_frame_of_world(const fst_params *params);

/* Turns or periods of the drive per second: drive.frequency, or what drive.omega is. */
FST_API double fst_drive_frequency(const fst_params *params);

/* How many periods of the drive have passed at the time `t` (1/gamma), when the magnet had turned by `turns`: these where it
 * turns steadily or in a ramp; the frequency times the time of any other drive, of which the magnet may turn back. */
FST_API double fst_drive_periods(const fst_params *params, double t, double turns);

/* The length of a run in drive periods: run.periods, or as many as run.duration has. */
FST_API double fst_run_periods(const fst_params *params);

/* FST_BAD_INPUT: a value was given that the choice of others leaves without effect (bead.a of a hard bead,
 * magnet.lines beside a map); the sentence says what to choose.  What only dry friction reads may wait under
 * another law.  fst_model_new() does not look, for a sweep may vary the choice: ask before a single run. */
FST_API fst_status fst_params_check_effects(const fst_params *params, fst_error *error);

/* What the runs of two scenes differ in: nothing at all, because the keys that differ have no effect beside the others (as
 * friction.mu under viscous friction); units alone, the motion in scaled numbers being the same; or the motion, which is
 * also the answer for several beads, for worlds, and where a scene makes no model. */
typedef enum { FST_CHANGE_NOTHING, FST_CHANGE_UNITS, FST_CHANGE_MOTION } fst_scene_change;
FST_API fst_scene_change fst_params_changes(const fst_params *one, const fst_params *other);

/* FST_BAD_INPUT: a part of the magnet cannot be as it is; a number is out of its range, a turn has no axis, or
 * the part touches or passes the plate.  The sentence names the part, from magnet.parts[0] on. */
FST_API fst_status fst_params_check_part(const fst_params *params, int part, fst_error *error);

/* A part of a magnet as pictures show it, in m along the magnet's axes: its outline seen from above (a convex
 * polygon, anticlockwise; none of a dipole), between which heights it lies, and how it is magnetised (T; a
 * dipole: A m^2). */
enum { FST_OUTLINE_MOST = 192 };
typedef struct fst_part_shape {
    int count; /* of corners */
    double corners[FST_OUTLINE_MOST][2];
    double low, high;
    double magnetisation[3];
} fst_part_shape;
FST_API fst_part_shape fst_part_seen(const fst_magnet_part *part);

/* Whether the bead's mass and radius contradict any material: the density is outside 1000 to 23000 kg/m^3, or
 * the radius was changed while nobody gave mass or magnetic strength (kappa); or a paramagnetic bead has a = 0.
 * Returns 0 if they do not; otherwise a sentence that says so is left in `sentence`.  A run is possible all the
 * same.  In a scaled scene, with model.eps, the radius plays no part. */
FST_API int fst_bead_contradiction(const fst_params *params, char *sentence, size_t size);

/* Whether two parts of a magnet are in one place, or a hole, a part of the opposite magnetisation within another one,
 * reaches beyond its body.  A part that fills a hole may be there.  0, or 1 with a sentence; a run is possible all the same. */
FST_API int fst_parts_contradiction(const fst_params *params, char *sentence, size_t size);

/* Whether fst_params_set() was given a bare number of more than 20 times the default that would be nearer to it in
 * another unit, as magnet.depth=8 (which is 8 m) and drive.frequency=642 (Hz).  Returns 0 if not; otherwise a sentence that
 * proposes the unit is left in `sentence`. */
FST_API int fst_params_bare_number(const fst_params *params, char *sentence, size_t size);

/* Whether the magnet's field is told in tesla (magnet.shape: parts), so that magnet.b0 is only a unit, and the
 * bead's moment gives kappa. */
FST_API int fst_magnet_in_tesla(const fst_params *params);

/* The bead's mass in kg, which bead.density may tell. */
FST_API double fst_bead_mass(const fst_params *params);

/* The bead's magnetic moment in A m^2, of whatever tells it (params.def); NAN: nothing does. */
FST_API double fst_bead_moment(const fst_params *params);

/* B0 in T, the unit of scaled fields; NaN: the scene does not tell it.  It needs no memory, so that units never fail. */
FST_API double fst_field_scale(const fst_params *params);

/* "rigid", "farago2020" */
FST_API const char *fst_dynamics_name(fst_dynamics dynamics);

/* The key of the other form of a quantity, which fst_params_set() clears; NULL: there is none. */
FST_API const char *fst_param_other_form(const char *key);

/* The value of a parameter as text, as a scene would say it in SI ("0.0025", "rigid"); "" where it was not
 * given.  Returns the length, as snprintf does. */
FST_API int fst_params_get(const fst_params *params, int index, char *text, size_t size);

/* The name in a '|'-separated list that is nearest to `word`, by edit distance, is copied to `nearest`; a name
 * that begins with `word` comes before all that are more than one edit away.  Returns the distance, or -1 where
 * the list is empty.  For "did you mean". */
FST_API int fst_nearest_name(const char *word, const char *names, char *nearest, size_t size);

/* What a sentence about an unknown word says of the names there are: "the nearest is coulomb (choices: viscous,
 * none, coulomb)" where one is near or means the same, "choose one of ..." where none is, because then the nearest
 * by letters would mislead.  Lists that are too long for a sentence are left out.  Returns `text`. */
enum { FST_SUGGESTION_SIZE = 640 };
FST_API const char *fst_suggest_name(const char *word, const char *names, char text[FST_SUGGESTION_SIZE]);

/* The place of a name in such a list, from 0; -1: it is not in it. */
FST_API int fst_name_place(const char *name, const char *names);

/* The name at a place of such a list, and its length; "": there is none. */
FST_API const char *fst_name_at(const char *names, int place, size_t *length);

/* Make a text from outside harmless for a terminal, a figure or a page.  A '?' replaces each control character
 * (also U+0080 to U+009F, which terminals obey, line and paragraph separators, and marks that turn the
 * direction of writing) and each byte that is not UTF-8.  The result is one line of UTF-8, never longer than
 * before.  Every fst_error has been through this function. */
FST_API void fst_text_tame(char *text);

/* ------------------------------------------------------------------ model */

/* The scaled groups on which the motion depends. */
typedef struct fst_groups {
    double eps;     /* R/l */
    double inertia; /* of the bead, I/(m R^2) */
    double h;       /* height of the bead's centre over the lines */
    double lambda;  /* spacing of the lines */
    double kappa;   /* magnetic strength; 0 for a paramagnetic bead */
    double a, b;    /* isotropic and uniaxial magnetisability, energy -a B^2 - b (n.B)^2 (params.def) */
    double omega;   /* drive */
    double gravity; /* g/(l gamma^2) */
    double plate_radius;
    double map_radius; /* of the disc about the axis that the map of magnet.file covers; infinite without map */
    int lines;
    fst_magnet_shape shape;
    fst_material material;
    fst_friction_law friction;
    fst_dynamics dynamics;
    double length_unit; /* l in m */
    double time_unit;   /* 1/gamma in s */
    double mass;        /* kg */
    double field_unit;  /* B0 in T where it follows from what was given, otherwise NAN */
} fst_groups;

typedef struct fst_model fst_model;

/* Check the parameters and make a model; free it with fst_model_free().  FST_BAD_INPUT: a value out of its
 * range, a struct that was never initialised, or quantities that contradict each other. */
FST_API fst_status fst_model_new(const fst_params *params, fst_model **model, fst_error *error);
FST_API void fst_model_free(fst_model *model);

FST_API fst_groups fst_model_groups(const fst_model *model);

/* A model of which only the field is asked, with a bead's force and load in it, at the height `height` (l) over
 * the magnet's reference plane; NAN: at that of a bead on the plate, as fst_model_new() has it.  It may lie
 * below the plate, beside parts of the magnet; in or on one, which fst_field_inside() finds, no field is told.
 * Where more than a turning magnet makes a field (fst_key_of_surroundings()), it is that of all, at the time 0, as
 * fst_field_at() tells it. */
FST_API fst_status fst_field_model_new(const fst_params *params, double height, fst_model **model,
                                       fst_error *error);

/* Let the field of such a model be that at a time (1/gamma), on the laboratory's axes; and that time, NAN unless one was
 * set. */
FST_API fst_status fst_field_model_at(fst_model *model, double time, fst_error *error);
FST_API double fst_field_time(const fst_model *model);

#define FST_STATE_SIZE 10
enum { FST_X, FST_Y, FST_VX, FST_VY, FST_NX, FST_NY, FST_NZ, FST_WX, FST_WY, FST_WZ };

/* The start state of start.r, start.phi, start.spin (rolling: the contact at rest, W along e_r; n = B/|B|), and
 * of the vectors that replace them.  FST_BAD_INPUT: it does not exist (rolling at r = eps, on the axis, or in a
 * vanishing field), or the bead is not on the plate. */
FST_API fst_status fst_start_state(const fst_params *params, const fst_model *model,
                                   double state[FST_STATE_SIZE], fst_error *error);

/* The field at the height of the bead's centre, in the magnet's frame (at the time 0 the laboratory's): b[3],
 * grad[i][j] = dB_i/dx_j (traceless, and symmetric but for the curl that a measured field has), scaled; NAN beyond
 * the samples of a map, in or on a part of the magnet, or where no bead's centre can be in a bowl.  Paper, section
 * IV: lines of dipoles, each two point charges, Eq. (11). */
FST_API void fst_field(const fst_model *model, double x, double y, double b[3], double grad[3][3]);

/* The part of the magnet in or on which that place lies, -1 if none; at the time of the model (fst_field_model_at()). */
FST_API int fst_field_inside(const fst_model *model, double x, double y);

/* That height, in l: in a bowl it grows from the axis; NAN where no bead's centre can be. */
FST_API double fst_field_height(const fst_model *model, double x, double y);

/* The magnetic force per mass (l gamma^2) on a bead there whose moment lies along the field, and the load on a
 * plate below it, in the same unit. */
FST_API void fst_field_pull(const fst_model *model, double x, double y, double force[3], double *load);

/* d(state)/dt in the turning frame, at the drive omega of the model. */
FST_API void fst_rhs(const fst_model *model, const double state[FST_STATE_SIZE],
                     double derivative[FST_STATE_SIZE]);

/* The exact Jacobian of that, jacobian[i][j] = d(derivative_i)/d(state_j), and, if `by_omega` is not NULL, the
 * derivative by omega. */
FST_API void fst_jacobian(const fst_model *model, const double state[FST_STATE_SIZE],
                          double jacobian[FST_STATE_SIZE][FST_STATE_SIZE], double by_omega[FST_STATE_SIZE]);

/* The velocity V = v - eps W x e of the bead's contact point on the plate, along X and Y. */
FST_API void fst_slip(const fst_model *model, const double state[FST_STATE_SIZE], double slip[2]);

/* Quantities of a state (paper, section IV and appendix; vectors in local components r, alpha, z). */
typedef struct fst_observation {
    double r, cos_bead_angle,
        sin_bead_angle;        /* distance; cos and sin of Phi, the bead's angle against the magnet */
    double n[3], b[3];         /* moment and field in (r, alpha, z) */
    double b_norm;             /* |B| */
    double angle;              /* between n and B, rad */
    double slip[2], slip_norm; /* V_r, V_alpha; |V| */
    double spin;               /* psi' = W.n */
    double load;               /* normal load per mass, l gamma^2 */
    double energy;             /* kinetic and magnetic energy per mass, l^2 gamma^2 */
    double friction_power;     /* f.V */
    double friction;           /* |f|, horizontal force between plate and bead per mass, l gamma^2 */
    double friction_use;       /* |f|/(mu_s N), of what static friction could take; 0 where that is nothing */
    int sticks;                /* the contact rolls without slipping, by its law */
    double drive_power;        /* dU/dt at fixed x, n, W */
} fst_observation;
FST_API fst_observation fst_observe(const fst_model *model, const double state[FST_STATE_SIZE]);

/* The symmetry S2 (the magnet turned by half a turn): (X, U, n, W) -> (P X, P U, -P n, P W). */
FST_API void fst_apply_s2(const double state[FST_STATE_SIZE], double image[FST_STATE_SIZE]);

/* ------------------------------------------------------------------ flow: one trajectory */

/* What acts on the bead besides the magnet and the plate of its model; vectors on the axes that turn with the
 * magnet, as those of a state. */
typedef struct fst_action {
    double field[3]; /* B at the bead's centre, B0; it adds to the magnet's, whatever the bead is made of */
    double gradient[3]
                   [3]; /* dB_i/dx_j there, B0/l: a field without it turns the bead, and does not pull at it */
    double force[3];    /* per mass, l gamma^2; the third component lifts the bead, and takes from its load */
    double torque[3];   /* about the bead's centre, per mass, l^2 gamma^2 */
} fst_action;

/* A field, a force or a torque of the caller's own, which may depend on time: for one trajectory at a time, by
 * fst_flow_options.outside.  act() is called for every stage of a step, also for steps that are then rejected, so
 * that `t` goes back as well as on and a state may be one that the bead never reaches; it is called in the thread
 * that calls fst_flow_new(), fst_flow_next() or fst_flow_get(), and must give the same for the same arguments, and
 * vary smoothly.  `t` is in 1/gamma; `phase`, 0 to 2 pi, is how far the magnet's axes have turned from those of the
 * laboratory; `action` is all zeros before.  A status other than FST_OK ends fst_flow_next() with it and with the
 * sentence in `error`; so does a number that is not finite, if no shorter step avoids it (FST_NOT_FINITE).
 *
 * It goes with contact laws without modes (friction.law viscous, none, and laws of one's own).  fst_run(), sweeps,
 * orbits, branches and exponents take none, and no scene or file holds one: their verdicts need the derivative of
 * all that acts, and lanes the same formulas for all runs.  A source or law of those is compiled in (docs/design.md).
 * fst_observe() and fst_rhs() know the model alone. */
typedef struct fst_outside {
    void *user;
    fst_status (*act)(void *user, double t, double phase, const double state[FST_STATE_SIZE],
                      fst_action *action, fst_error *error);
} fst_outside;

typedef struct fst_flow_options {
    uint32_t cookie;
    double rtol;                 /* relative tolerance of a step */
    double atol[FST_STATE_SIZE]; /* absolute tolerance of each component */
    double first_step;           /* 0: chosen from the start state */
    double greatest_step;        /* 0: no bound */
    double ramp;                 /* d(omega)/dt: a slow frequency ramp */
    /* Asked by each call of fst_flow_next(), by the fraction of its time that is done (NULL: nobody is
     * asked).  After a status other than FST_OK the flow stands where it was last, and may go on. */
    const fst_progress *progress;
    const fst_outside *outside; /* copied by fst_flow_new(); NULL: the model alone acts on the bead */
} fst_flow_options;

/* rtol = atol = FST_DEFAULT_RTOL, no bound on the step, no ramp, nothing from outside. */
FST_API fst_flow_options fst_default_flow_options(void);

typedef struct fst_flow fst_flow;

/* A trajectory from `state` at t = 0, by Dormand and Prince's method of order 8(5,3) with its dense output of
 * order 7.  Its bits depend on the model, the options, the state, and the times on which it was made to land
 * (t_end of fst_flow_next), and on nothing else; events do not disturb it. */
FST_API fst_status fst_flow_new(const fst_model *model, const fst_flow_options *options,
                                const double state[FST_STATE_SIZE], fst_flow **flow, fst_error *error);
FST_API void fst_flow_free(fst_flow *flow);

/* Why fst_flow_next() returned, and at which events it is to: a flag for each row of FST_STOPS (lists.def). */
enum { FST_STOPS(FST_ROW_PLACE) FST_STOP_COUNT };
typedef enum { FST_STOPS(FST_ROW_FLAG) } fst_stop;

/* Go on until t_end or the first event in `events`, a sum (|) of FST_AT_*.  The state is then that at the
 * event, located on the dense output to rounding, and the next call goes on from there.  Where the mode of a
 * contact or of rolling changes, the new one has begun; of several events at one time each is told by a call of
 * its own. FST_STEP_UNDERFLOW, FST_NOT_FINITE: `error` says at which time this was, and where the bead was.
 * FST_BAD_INPUT: another call is advancing this flow; a library built without NDEBUG aborts there. */
FST_API fst_status fst_flow_next(fst_flow *flow, double t_end, unsigned events, fst_stop *stop,
                                 fst_error *error);

typedef struct fst_flow_info {
    double t, t_low; /* time, as the unevaluated sum of two doubles */
    double state[FST_STATE_SIZE];
    double omega;       /* drive at t */
    double step;        /* step size proposed for the next step */
    double bead_angle;  /* Phi, unwrapped */
    double alpha;       /* alpha = Phi + drive phase, unwrapped */
    double drive_turns; /* turns of the magnet since t = 0 */
    double norm_drift;  /* the sum of all | |n| - 1 | that renormalisation removed */
    uint64_t rhs_calls, accepted, rejected;
    int sticks; /* the contact rolls without slipping */
    int flies;  /* the bead is in the air */
    int rests;  /* the bead does not roll, on a plate that resists it */
} fst_flow_info;
FST_API fst_flow_info fst_flow_get(const fst_flow *flow);

/* ------------------------------------------------------------------ run: what a person asks for */

typedef enum { FST_REGIMES(FST_ROW_ENUM) FST_REGIME_COUNT } fst_regime;
typedef enum { FST_SYMMETRIES(FST_ROW_ENUM) FST_SYMMETRY_COUNT } fst_symmetry;

/* "counter-rotating", "S2"; fst_symmetry_name gives NULL for no symmetry. */
FST_API const char *fst_regime_name(fst_regime regime);
FST_API const char *fst_symmetry_name(fst_symmetry symmetry);

/* The result of a run.  A number that is undefined is NAN. */
typedef struct fst_run_result {
#define FST_RESULT(name, unit, doc) double name;
#include <festoon/run.def>
#undef FST_RESULT
    fst_regime regime;
    fst_symmetry symmetry;
    int never_slips; /* dry friction: whether the contact stuck in all of the means; -1: other laws, not known */
    char reason[256]; /* why this regime: the criterion and its numbers */
    uint64_t rhs_calls;
    uint64_t accepted, rejected; /* steps */
    int64_t returns;             /* half turns of Phi in the window of the means */
    double final_state[FST_STATE_SIZE];
} fst_run_result;

/* One row of run.def. */
typedef struct fst_result_info {
    const char *name, *unit, *doc;
    size_t offset; /* of the double in fst_run_result */
} fst_result_info;
FST_API int fst_result_count(void);
FST_API const fst_result_info *fst_result_at(int index);

/* One sample of a trajectory, or the means of one piece of a ramp. */
typedef struct fst_sample {
    double t;           /* 1/gamma */
    double drive_turns; /* turns of the magnet since the start */
    double omega;       /* drive at t */
    double state[FST_STATE_SIZE];
    double bead_angle, alpha; /* unwrapped Phi and alpha */
    double x, y;              /* position in the laboratory */
    double n_lab[3], w_lab[3], v_lab[2];
    fst_observation seen;
    int flies;            /* the bead is in the air, */
    double height, climb; /* at this height over its place on the plate, rising at this speed */
} fst_sample;
typedef struct fst_ramp_point {
    double omega, frequency_hz, mean_r, std_r, mean_alpha_dot, mean_phi_dot, mean_nz;
    int settled; /* the ramp waited here until the orbit closed; 0: it did not wait, or not until then */
} fst_ramp_point;

/* Where a run puts its samples and ramp points.  Either callback may be NULL.  A callback that returns a status
 * other than FST_OK ends the run with that status; it fills in `error` itself. */
typedef struct fst_run_sink {
    void *user;
    fst_status (*sample)(void *user, const fst_sample *sample, fst_error *error);
    fst_status (*ramp_point)(void *user, const fst_ramp_point *point, fst_error *error);
} fst_run_sink;

typedef struct fst_run_options {
    uint32_t cookie;
    fst_run_sink sink;
    const fst_progress *progress; /* NULL: nobody is told */
    double ramp_from, ramp_to;    /* drive omega at the start and end of a ramp; NAN: no ramp */
    int ramp_points;              /* pieces of the ramp, over each of which means are taken */
    double ramp_wait; /* the most turns of the magnet for which each piece waits, half way through, until the
                         motion has settled; 0: the drive changes steadily */
    double ramp_disturbance; /* the size of the disturbance with which the motion starts there, scaled */
    double sample_from;      /* no sample is taken in the drive periods before this one */
    double sample_spacing;   /* the time between two samples, 1/gamma; 0: run.samples in each drive period */
    const double *start;     /* FST_STATE_SIZE numbers: the state at the start; NULL: that of start.* */
} fst_run_options;
FST_API fst_run_options fst_default_run_options(void);

/* Simulate `params` and describe the motion.  docs/regimes.md says how the regime is decided.  Ejected, lifted,
 * chaotic and undecided are results; FST_STEP_UNDERFLOW and FST_NOT_FINITE are failures.  With FST_INTERRUPTED
 * (from a callback) the result holds what was done until then. */
FST_API fst_status fst_run(const fst_params *params, const fst_run_options *options, fst_run_result *result,
                           fst_error *error);

#ifdef __cplusplus
}
#endif

#include <festoon/field_maps.h>
#include <festoon/orbits.h>
#include <festoon/rows.h>

#endif
