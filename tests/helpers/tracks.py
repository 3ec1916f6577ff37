"""Tracks made by formula, and the formats in which other programs write them: what test_measure_*.py feed to festoon.

A made-up bead circles clockwise, against the magnet, and r oscillates as festoons do:
alpha = -2 pi f_bead t, r = r0 + A cos(2 pi (f_drive + f_bead) t).
"""

import math
import random

R0, SWING, BEAD, DRIVE = 80.0, 6.0, 3.2, 12.8  # px, px, Hz, Hz
FESTOONS = 1 + DRIVE / BEAD
CENTRE = (320.25, 240.5)  # px, in the picture, y down
HEIGHT = 480


def places(seconds=4.0, fps=240.0, noise=0.05, sense=-1, seed=1, bead=BEAD, drive=DRIVE, swing=SWING, r0=R0):
    """A list of (x, y) in px about the centre, y up, a frame each."""
    chance = random.Random(seed)
    rows = []
    for frame in range(int(seconds * fps)):
        t = frame / fps
        alpha = sense * 2 * math.pi * bead * t
        r = r0 + swing * math.cos(2 * math.pi * (drive + bead) * t)
        rows.append((r * math.cos(alpha) + chance.gauss(0, noise), r * math.sin(alpha) + chance.gauss(0, noise)))
    return rows


def picture(rows):
    """The same in the picture: origin at the top left, y down."""
    return [(CENTRE[0] + x, CENTRE[1] - y) for x, y in rows]


def own(rows, fps=240.0, unit="px", lost=()):
    lines = [f"frame,t [s],x [{unit}],y [{unit}]"]
    for frame, (x, y) in enumerate(rows):
        lines.append(f"{frame},{frame / fps:.7f}," + ("," if frame in lost else f"{x:.4f},{y:.4f}"))
    return "\n".join(lines) + "\n"


def generic(rows, fps=240.0):
    """Semicolons, decimal commas, milliseconds, CRLF, a byte order mark, a foreign column, blank lines."""
    lines = ["\ufeffTime [ms];quality;x (px);y (px)", ""]
    lines += [f"{1000 * i / fps:.4f};good;{x:.3f};{y:.3f}".replace(".", ",") for i, (x, y) in enumerate(rows)]
    return "\r\n".join(lines) + "\r\n"


def tracker(rows, fps=240.0, scale=0.001):
    """Tracker's text, German: tabs, decimal commas, U+2212 as minus, in the exponents too.  Metres."""
    def number(value):
        return f"{value:.5E}".replace(".", ",").replace("-", "\u2212")

    lines = ["Masse_A", "t\tx\ty"]
    lines += ["\t".join(map(number, (i / fps, scale * x, scale * y))) for i, (x, y) in enumerate(rows)]
    return "\n".join(lines) + "\n"


def tracker_two(rows, fps=240.0, scale=0.001):
    """Two tracks side by side; the second one is the longer."""
    lines = [",mass_A,,,,mass_C", "t,x,y,vx,vy,x,y"]
    for i, (x, y) in enumerate(rows):
        first = f"{0.1 * i:.3f},{0.2:.3f},1,2" if i < 40 else ",,,"
        lines.append(f"{i / fps:.6f},{first},{scale * x:.7f},{scale * y:.7f}")
    return "\n".join(lines) + "\n"


def trk(rows, fps=240.0, pixels_per_unit=2000.0, angle=12.0):
    """A project of Tracker: pixels, y down, axes with origin, angle and scale; frames from 0."""
    package = "org.opensourcephysics"

    def prop(name, kind, value):
        return f'<property name="{name}" type="{kind}">{value}</property>'

    def frame(n, cls, *values):
        inner = "".join(prop(name, "double", value) for name, value in values)
        return f'<property name="[{n}]" type="object">\n<object class="{cls}">{inner}</object>\n</property>\n'

    axes = f"{package}.media.core.ImageCoordSystem"
    mass = f"{package}.cabrillo.tracker.PointMass"
    marks = "".join(frame(n, mass + "$FrameData", ("x", f"{x:.4f}"), ("y", f"{y:.4f}"))
                    for n, (x, y) in enumerate(picture(rows)))
    origin = frame(0, axes + "$FrameData", ("xorigin", CENTRE[0]), ("yorigin", CENTRE[1]), ("angle", angle),
                   ("xscale", pixels_per_unit), ("yscale", pixels_per_unit))
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<!-- made by hand -->
<object class="{package}.cabrillo.tracker.TrackerPanel">
{prop("version", "string", "4.90")}
<property name="videoclip" type="object"><object class="{package}.media.core.VideoClip">
<property name="video" type="object"><object class="{package}.media.core.ImageVideo">
{prop("delta_t", "double", 100.0)}</object></property></object></property>
<property name="clipcontrol" type="object"><object class="{package}.media.core.StepperClipControl">
{prop("delta_t", "double", 1000 / fps)}</object></property>
<property name="coords" type="object"><object class="{axes}">
<property name="framedata" type="array" class="[L{axes}$FrameData;">
{origin}</property></object></property>
{prop("length_unit", "string", "m")}
<property name="tracks" type="collection" class="java.util.ArrayList">
<property name="item" type="object"><object class="{package}.cabrillo.tracker.CoordAxes">
{prop("name", "string", "Achsen")}</object></property>
<property name="item" type="object"><object class="{mass}">
{prop("mass", "double", "1.0")}{prop("name", "string", "masse A &amp; B")}
<property name="framedata" type="array" class="[L{mass}$FrameData;">
{marks}</property></object></property></property>
</object>
"""


def trackpy(rows):
    lines = [",y,x,mass,size,ecc,signal,raw_mass,ep,frame,particle"]
    for i, (x, y) in enumerate(picture(rows)):
        lines.append(f"{2 * i},{y},{x},900.1,2.5,0.1,20,1000,0.05,{i},7")
        if i % 10 == 0:
            lines.append(f"{2 * i + 1},{11.5},{12.5},90.1,2.5,0.1,20,1000,0.05,{i},3")
    return "\n".join(lines) + "\n"


def trackmate(rows, fps=240.0, micron=1.0):
    """Spots in any order, three lines of names and units, some spots of no track."""
    lines = ["LABEL,ID,TRACK_ID,QUALITY,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME,RADIUS",
             "Label,Spot ID,Track ID,Quality,X,Y,Z,T,Frame,Radius",
             "Label,Spot ID,Track ID,Quality,X,Y,Z,T,Frame,R",
             ",,,(quality),(micron),(micron),(micron),(sec),,(micron)"]
    spots = [f"ID{i},{i},0,5.1,{micron * x},{micron * y},0,{i / fps},{i},2.5" for i, (x, y) in enumerate(picture(rows))]
    spots += [f"ID{9000 + i},{9000 + i},,1.1,{i},3,0,{i / fps},{i},2.5" for i in range(50)]
    random.Random(3).shuffle(spots)
    return "\n".join(lines + spots) + "\n"


def trackmate_simple(rows, fps=240.0):
    lines = ['<?xml version="1.0" encoding="UTF-8"?>',
             f'<Tracks nTracks="2" spaceUnits="pixel" frameInterval="{1000 / fps}" timeUnits="ms" from="TrackMate v7">',
             '  <particle nSpots="2">', '    <detection t="0" x="1.0" y="2.0" z="0.0" />',
             '    <detection t="1" x="1.5" y="2.0" z="0.0" />', "  </particle>", f'  <particle nSpots="{len(rows)}">']
    lines += [f'    <detection t="{i}" x="{x}" y="{y}" z="0.0" />' for i, (x, y) in enumerate(picture(rows))]
    return "\n".join(lines + ["  </particle>", "</Tracks>"]) + "\n"


def trackmate_model(rows, fps=240.0):
    points = picture(rows)
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<TrackMate version="7.6.1">',
             '  <Model spatialunits="pixel" timeunits="sec">', "    <AllSpots>"]
    for i, (x, y) in enumerate(points):
        lines.append(f'<SpotsInFrame frame="{i}"><Spot ID="{500 + i}" name="ID{i}" FRAME="{i}" POSITION_X="{x}" '
                     f'POSITION_Y="{y}" POSITION_T="{i / fps}" /><Spot ID="{90000 + i}" FRAME="{i}" POSITION_X="5" '
                     f'POSITION_Y="{i}"/></SpotsInFrame>')
    lines += ["    </AllSpots>", "    <AllTracks>", '      <Track name="Track_0" TRACK_ID="0">']
    lines += [f'<Edge SPOT_SOURCE_ID="{500 + i}" SPOT_TARGET_ID="{501 + i}" LINK_COST="1.0"/>'
              for i in range(len(points) - 1)]
    lines += ["      </Track>", "    </AllTracks>", "  </Model>", '  <Settings><ImageData filename="a" pixelwidth="1.0" '
              f'timeinterval="{1 / fps}"/></Settings>', "</TrackMate>"]
    return "\n".join(lines) + "\n"


def imagej(rows):
    lines = ["Nb\tTrack n\u00b0\tSlice n\u00b0\tX\tY\tDistance\tVelocity\tPixel Value"]
    lines += [f"{i + 1}\t1\t{i + 1}\t{x:.2f}\t{y:.2f}\t{-1 if i == 0 else 2.1}\t{-1 if i == 0 else 3.3}\t120"
              for i, (x, y) in enumerate(picture(rows))]
    return ("\n".join(lines) + "\n").encode("latin-1")


def mtrackj(rows):
    lines = ["MTrackJ 1.5.1 Data File", "Displaying true true true 1 2 0 4 100 15 0 0 2 1 12 0 true true true false",
             "Assembly 1 FF0000", "Cluster 1 FF0000", "Track 1 FF0000 true", "Point 1 5.0 6.0 1.0 1.0 1.0", "Track 2"]
    lines += [f"Point {i + 1} {x} {y} 1.0 {i + 1}.0 1.0" for i, (x, y) in enumerate(picture(rows))]
    return "\n".join(lines + ["End of MTrackJ Data File"]) + "\n"


def dltdv(rows, version):
    """Pixels from 1, the origin at the top left (8) or at the bottom left (5); NaN where lost."""
    lines = ["pt1_cam1_X,pt1_cam1_Y,pt2_cam1_X,pt2_cam1_Y"]
    for i, (x, y) in enumerate(picture(rows)):
        up = y + 1 if version == 8 else HEIGHT - y
        lines.append(f"{x + 1:.3f},{up:.3f}," + ("10.0,12.0" if i < 5 else "NaN,NaN"))
    return "\n".join(lines) + "\n"
