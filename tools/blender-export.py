#!/usr/bin/env python3
"""Write the tracks of a film that was tracked with Blender as a table that festoon measure reads.

    blender FILM.blend --background --python tools/blender-export.py -- TRACKS.csv [CLIP]

or, within Blender, in the text editor: open this file, and run it; TRACKS.csv then lies beside the .blend file.

Each track of the clip becomes rows `frame,t [s],x [px],y [px],track`: frames of the film from 1 as Blender counts them,
times by the clip's frame rate, places in pixels from the lower left corner of the picture, y up.  A frame in which the
marker is muted has empty cells: the bead was lost there.  festoon measure takes the longest track, or --only NAME.

Without Blender this file can be imported: table() makes the text of any object that looks like a clip.
"""

import os
import sys

HEAD = "frame,t [s],x [px],y [px],track"


def quoted(name):
    """A name as a cell of a table."""
    return '"' + name.replace('"', "'").replace("\n", " ") + '"'


def rows_of(track, width, height, fps, first):
    """The rows of one track.  marker.co runs from 0 to 1 over the picture, from its lower left corner."""
    for marker in sorted(track.markers, key=lambda marker: marker.frame):
        frame = marker.frame + first - 1
        cells = [str(frame), f"{(frame - 1) / fps:.9g}", "", "", quoted(track.name)]
        if not marker.mute:
            cells[2:4] = [f"{marker.co[0] * width:.4f}", f"{marker.co[1] * height:.4f}"]
        yield ",".join(cells)


def table(clip):
    """All tracks of a clip, also those of further objects, as text."""
    width, height = clip.size
    first = getattr(clip, "frame_start", 1)
    objects = list(getattr(clip.tracking, "objects", []))
    tracks = list(clip.tracking.tracks)
    for one in objects:
        tracks += [track for track in one.tracks if track not in tracks]
    lines = [HEAD]
    for track in tracks:
        lines += rows_of(track, width, height, clip.fps, first)
    if len(lines) == 1:
        raise SystemExit(f"the clip {clip.name} has no tracked marker")
    return "\n".join(lines) + "\n"


def chosen_clip(clips, name):
    """The clip of this name, or the only one."""
    names = [clip.name for clip in clips]
    if name is not None and name not in names:
        raise SystemExit(f"there is no clip {name}; these are: {', '.join(names) or 'none'}")
    if name is None and len(names) != 1:
        raise SystemExit(f"{len(names)} clips: name one of them ({', '.join(names)})")
    return next(clip for clip in clips if name is None or clip.name == name)


def main():
    import bpy

    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    path = words[0] if words else os.path.join(os.path.dirname(bpy.data.filepath), "TRACKS.csv")
    text = table(chosen_clip(list(bpy.data.movieclips), words[1] if len(words) > 1 else None))
    with open(path, "w", encoding="utf-8") as out:
        out.write(text)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
