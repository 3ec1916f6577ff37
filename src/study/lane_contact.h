/* lane_contact.h - steps in lanes that may end the mode of a dry contact, or the way (lane_contact.c). */
#ifndef FST_STUDY_LANE_CONTACT_H
#define FST_STUDY_LANE_CONTACT_H

#include "lanes/lanes.h"

/* A batch of an engine, and of each lane the trajectory's own flow, and how far its way goes. */
typedef struct fst_lane_flows {
    const fst_lane_engine *engine;
    void *memory;
    fst_flow *flows[FST_MOST_LANES];
    double limits[FST_MOST_LANES];
} fst_lane_flows;

static inline unsigned fst_lane_bit(int l)
{
    return 1u << l;
}

/* What becomes of the steps that are good, but in which a mode or the way may end. */
typedef struct fst_lane_contacts {
    unsigned passed; /* these are accepted after all */
    unsigned turned; /* accepted steps after which a mode begins, or an onset goes on */
    unsigned landed; /* the way ends in these: not accepted, see fst_lane_land() */
} fst_lane_contacts;

fst_lane_contacts fst_lanes_look_at_contacts(const fst_lane_flows *at, fst_lane_tries tries);

/* Make the last step of a lane by its flow, up to the end of its way. */
void fst_lane_land(const fst_lane_flows *at, int l);

#endif
