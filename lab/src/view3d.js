/* view3d.js - the stirrer in three dimensions, by WebGL: z is up, the plate's surface is z = 0, lengths are in l. */
import {
    AmbientLight, BufferAttribute, BufferGeometry, CanvasTexture, CircleGeometry, Color, ConeGeometry, CylinderGeometry,
    DirectionalLight, DoubleSide, DynamicDrawUsage, Group, Mesh, MeshBasicMaterial, MeshPhongMaterial, PerspectiveCamera,
    LatheGeometry, PlaneGeometry, Quaternion, RepeatWrapping, RingGeometry, Scene, SphereGeometry, SRGBColorSpace, Vector2, Vector3, WebGLRenderer,
    BoxGeometry,
} from "three";
import { COLUMN } from "./core.js";
import { ARROWS, FRICTION, GROUND, LOAD, NORTH, SOUTH, TOUCH, trackColours } from "./colours.js";
import { pictureOf } from "./magnet.js";
import { PALETTE } from "./trail.js";

const TRACK_ROOM = 20000, FOV = 34, OLD = 0.75, BACK = [0.2, 0.23, 0.28];

/* The bead's skin: a red half about its north pole, a blue one about the other, and marks that show every turn. */
function beadTexture() {
    const canvas = document.createElement("canvas");
    canvas.width = 1024;
    canvas.height = 512;
    const pen = canvas.getContext("2d");
    pen.fillStyle = NORTH;
    pen.fillRect(0, 0, 1024, 256);
    pen.fillStyle = SOUTH;
    pen.fillRect(0, 256, 1024, 256);
    pen.fillStyle = "#f7f3e8";
    pen.fillRect(0, 248, 1024, 16);
    for (let i = 0; i < 4; ++i)
        pen.fillRect(256 * i, 36, i === 0 ? 34 : 16, 440);
    for (let i = 0; i < 8; ++i) {
        pen.beginPath();
        pen.ellipse(128 * i + 64, i % 2 ? 150 : 362, 26, 20, 0, 0, 2 * Math.PI);
        pen.fill();
    }
    pen.fillRect(0, 0, 1024, 34);
    pen.fillStyle = "#15181d";
    pen.fillRect(0, 478, 1024, 34);
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = SRGBColorSpace;
    texture.anisotropy = 4;
    return texture;
}

function shadowTexture() {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 128;
    const pen = canvas.getContext("2d"), fade = pen.createRadialGradient(64, 64, 4, 64, 64, 62);
    fade.addColorStop(0, "rgba(0,0,0,0.75)");
    fade.addColorStop(0.45, "rgba(0,0,0,0.4)");
    fade.addColorStop(1, "rgba(0,0,0,0)");
    pen.fillStyle = fade;
    pen.fillRect(0, 0, 128, 128);
    return new CanvasTexture(canvas);
}

/* Bands where a travelling field points up and down, for one wave length. */
function waveTexture() {
    const canvas = document.createElement("canvas");
    canvas.width = 256;
    canvas.height = 1;
    const pen = canvas.getContext("2d");
    for (let i = 0; i < 256; ++i) {
        const up = -Math.sin((2 * Math.PI * (i + 0.5)) / 256);
        pen.globalAlpha = Math.abs(up);
        pen.fillStyle = up > 0 ? NORTH : SOUTH;
        pen.fillRect(i, 0, 1, 1);
    }
    const texture = new CanvasTexture(canvas);
    texture.wrapS = RepeatWrapping;
    return texture;
}

class Arrow {
    constructor(colour) {
        const material = new MeshPhongMaterial({ color: colour, emissive: colour, emissiveIntensity: 0.35 });
        this.shaft = new Mesh(new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0), material);
        this.head = new Mesh(new ConeGeometry(1, 1, 16).translate(0, 0.5, 0), material);
        this.group = new Group();
        this.group.add(this.shaft, this.head);
    }

    point(from, vector, thickness) {
        const length = Math.hypot(...vector), head = Math.min(length, 5 * thickness);
        this.group.visible = length > thickness;
        if (!this.group.visible)
            return;
        this.group.position.set(...from);
        this.group.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...vector).divideScalar(length));
        this.shaft.scale.set(thickness, length - head, thickness);
        this.head.scale.set(2.4 * thickness, head, 2.4 * thickness);
        this.head.position.y = length - head;
    }
}

/* A ribbon through `room` places, of its own colour at each. */
class Ribbon {
    constructor(room) {
        this.places = new Float32Array(6 * room);
        this.colours = new Float32Array(6 * room);
        const order = new Uint32Array(6 * (room - 1));
        for (let i = 0; i < room - 1; ++i)
            order.set([2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 2, 2 * i + 1, 2 * i + 3], 6 * i);
        this.geometry = new BufferGeometry();
        this.geometry.setAttribute("position", new BufferAttribute(this.places, 3).setUsage(DynamicDrawUsage));
        this.geometry.setAttribute("color", new BufferAttribute(this.colours, 3).setUsage(DynamicDrawUsage));
        this.geometry.setIndex(new BufferAttribute(order, 1));
        this.mesh = new Mesh(this.geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
        this.mesh.frustumCulled = false;
    }

    /* `place(i)` and `colour(i)` for i below `count`. */
    fill(count, place, colour, width) {
        let before = count > 0 ? place(0) : [0, 0, 0], at = before;
        for (let i = 0; i < count; ++i) {
            const after = i + 1 < count ? place(i + 1) : at;
            const dx = after[0] - before[0], dy = after[1] - before[1], length = Math.hypot(dx, dy) || 1;
            const sx = (-dy / length) * width, sy = (dx / length) * width;
            const z = at[2] ?? 0.004;
            this.places.set([at[0] + sx, at[1] + sy, z, at[0] - sx, at[1] - sy, z], 6 * i);
            const c = colour(i);
            this.colours.set(c, 6 * i);
            this.colours.set(c, 6 * i + 3);
            before = at;
            at = after;
        }
        this.geometry.setDrawRange(0, 6 * Math.max(0, count - 1));
        this.geometry.attributes.position.needsUpdate = true;
        this.geometry.attributes.color.needsUpdate = true;
    }
}

function halves(body) {
    const north = new MeshPhongMaterial({ color: NORTH, shininess: 30 }), south = new MeshPhongMaterial({ color: SOUTH, shininess: 30 });
    const group = new Group(), axis = new Vector3(...body.axis), a = body.axis.map(Math.abs);
    const main = a.indexOf(Math.max(...a)), sign = Math.sign(body.axis[main]) || 1;
    if (body.kind === "sphere" || body.kind === "dipole") {
        const radius = (body.size?.[0] || 0.1) / 2;
        const up = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), axis.normalize());
        group.add(new Mesh(new SphereGeometry(radius, 32, 12, 0, 2 * Math.PI, 0, Math.PI / 2), north),
            new Mesh(new SphereGeometry(radius, 32, 12, 0, 2 * Math.PI, Math.PI / 2, Math.PI / 2), south));
        group.quaternion.copy(up);
    } else if (body.kind === "cylinder") {
        const [diameter, height] = body.size;
        for (const half of [0, 1]) {
            const along = main === 2;
            const shape = along ? new CylinderGeometry(diameter / 2, diameter / 2, height / 2, 48)
                : new CylinderGeometry(diameter / 2, diameter / 2, height, 48, 1, false, half * Math.PI, Math.PI);
            const mesh = new Mesh(shape, (half === 0) === (sign > 0) ? north : south);
            mesh.rotation.x = Math.PI / 2;
            if (along)
                mesh.position.z = (half === 0 ? 1 : -1) * height / 4;
            else if (main === 1)
                mesh.rotation.y = Math.PI / 2;
            group.add(mesh);
        }
    } else {
        const size = body.size.map((edge, i) => (i === main ? edge / 2 : edge));
        for (const half of [1, -1]) {
            const mesh = new Mesh(new BoxGeometry(...size), half === sign ? north : south);
            mesh.position.setComponent(main, (half * body.size[main]) / 4);
            group.add(mesh);
        }
    }
    if (body.turn)
        group.applyQuaternion(new Quaternion().setFromAxisAngle(new Vector3(...body.turn.slice(1)).normalize(),
            (body.turn[0] * Math.PI) / 180));
    group.position.set(...body.centre);
    return group;
}

export class View3D {
    constructor(canvas, room) {
        this.canvas = canvas;
        this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
        this.lieOn(GROUND.screen);
        this.scene = new Scene();
        this.eye = new PerspectiveCamera(FOV, 1, 0.01, 100);
        const sun = new DirectionalLight("#ffffff", 2.2);
        sun.position.set(2, -3, 5);
        this.scene.add(sun, new AmbientLight("#ffffff", 1.25));
        this.magnet = new Group();
        this.turning = new Group();
        this.turning.add(this.magnet);
        this.scene.add(this.turning);
        this.plate = new Group();
        this.scene.add(this.plate);
        this.room = room;
        this.skin = new MeshPhongMaterial({ map: beadTexture(), shininess: 70, specular: "#666666" });
        this.shade = new MeshBasicMaterial({ map: shadowTexture(), transparent: true, depthWrite: false });
        this.beads = [];
        this.dots = [];
        this.tracks = [];
        this.arrows = Object.fromEntries(Object.entries(ARROWS).map(([name, colour]) => [name, new Arrow(colour)]));
        for (const arrow of Object.values(this.arrows))
            this.scene.add(arrow.group);
        this.poleTurn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(0, 0, 1));
    }

    /* As many beads as there are radii: ball, shadow, ribbon, and of several a ring in the bead's colour. */
    provide(setup) {
        while (this.beads.length < setup.radii.length) {
            const bead = {
                ball: new Mesh(new SphereGeometry(1, 64, 40), this.skin), shadow: new Mesh(new PlaneGeometry(1, 1), this.shade), ribbon: new Ribbon(this.room + 1),
                ring: new Mesh(new RingGeometry(1.02, 1.16, 64), new MeshBasicMaterial({ side: DoubleSide })),
            };
            bead.shadow.renderOrder = 3;
            bead.ribbon.mesh.renderOrder = 2;
            this.scene.add(bead.ball, bead.shadow, bead.ribbon.mesh, bead.ring);
            this.beads.push(bead);
        }
        this.beads.forEach(({ ball, shadow, ribbon, ring }, i) => {
            const there = i < setup.radii.length;
            ball.visible = ribbon.mesh.visible = there;
            shadow.visible = there && setup.plate === "flat";
            ring.visible = there && setup.colours !== null;
            if (!there)
                return;
            ball.scale.setScalar(setup.radii[i]);
            ring.scale.setScalar(setup.radii[i]);
            shadow.scale.setScalar(3.2 * setup.radii[i]);
            if (setup.colours)
                ring.material.color.set(setup.colours[i]);
        });
    }

    /* A bowl: a part of a sphere about the axis, as far as the plate goes. */
    bowl(setup, material) {
        const widest = Math.min(setup.plateRadius, 0.9 * setup.bowl, 2.2), profile = Array.from({ length: 33 }, (_, i) => {
            const r = (widest * i) / 32;
            return new Vector2(r, setup.bowl - Math.sqrt(setup.bowl ** 2 - r * r));
        });
        const mesh = new Mesh(new LatheGeometry(profile, 96), material);
        mesh.rotation.x = Math.PI / 2;
        return mesh;
    }

    /* The bands of a wave, which the picture goes along. */
    bands(setup) {
        const side = 80 * setup.eps, texture = waveTexture();
        texture.repeat.x = side / setup.wave.length;
        const mesh = new Mesh(new PlaneGeometry(side, side / 2), new MeshBasicMaterial({ map: texture, transparent: true, opacity: 0.75, side: DoubleSide, depthWrite: false }));
        mesh.position.z = -0.01;
        return { mesh, texture, side };
    }

    lieOn(colour) {
        this.renderer.setClearColor(new Color(colour));
    }

    /* Plate and magnet of a setup. */
    furnish(setup) {
        for (const group of [this.plate, this.magnet]) {
            group.traverse((thing) => thing.geometry?.dispose());
            group.clear();
        }
        const glass = new MeshPhongMaterial({ color: "#cfe0ee", transparent: true, opacity: 0.2, side: DoubleSide, depthWrite: false });
        this.plate.visible = setup.plate !== "none";
        this.wave = setup.wave ? this.bands(setup) : null;
        if (this.wave)
            this.plate.add(this.wave.mesh);
        const plate = setup.plate === "bowl" ? this.bowl(setup, glass) : new Mesh(new CircleGeometry(setup.plateRadius, 96), glass);
        plate.renderOrder = 1;
        this.plate.add(plate);
        const line = new MeshBasicMaterial({ color: "#e8eef5", transparent: true, opacity: 0.28, side: DoubleSide, depthWrite: false });
        for (let i = 1; !setup.wave && i * setup.ring < Math.min(setup.plateRadius, 3.2); ++i) {
            const ring = new Mesh(new RingGeometry(i * setup.ring - 0.004, i * setup.ring + 0.004, 128), line);
            ring.position.z = 0.001 + (setup.plate === "bowl" && i * setup.ring < setup.bowl ? setup.bowl - Math.sqrt(setup.bowl ** 2 - (i * setup.ring) ** 2) : 0);
            ring.renderOrder = 1;
            this.plate.add(ring);
        }
        const rim = new Mesh(new RingGeometry(setup.plateRadius - 0.03, setup.plateRadius, 128), line);
        this.plate.add(rim);
        for (const body of setup.bodies)
            this.magnet.add(halves(body));
        this.measured?.dispose();
        this.measured = setup.map && new CanvasTexture(pictureOf(setup.map));
        if (setup.map) {
            const { radius } = setup.map, material = new MeshBasicMaterial({ map: this.measured, transparent: true, opacity: 0.7, side: DoubleSide, depthWrite: false });
            this.measured.flipY = false; /* its first row lies at the least y */
            this.measured.colorSpace = SRGBColorSpace;
            this.magnet.add(new Mesh(new PlaneGeometry(2 * radius, 2 * radius).translate(0, 0, -0.012), material));
        }
        rim.visible = setup.plate === "flat";
        this.provide(setup);
        this.setup = setup;
    }

    showTrack(tracks) {
        while (this.tracks.length < tracks.length) {
            const ribbon = new Ribbon(TRACK_ROOM);
            ribbon.mesh.renderOrder = 2;
            this.scene.add(ribbon.mesh);
            this.tracks.push(ribbon);
        }
        this.tracks.forEach((ribbon, k) => {
            const points = tracks[k] ?? [], every = Math.ceil(points.length / TRACK_ROOM); /* a long track is drawn by fewer of its places */
            ribbon.mesh.visible = k < tracks.length;
            if (!ribbon.mesh.visible)
                return;
            const colour = new Color(trackColours(tracks.length)[k]).toArray();
            ribbon.fill(Math.ceil(points.length / every), (i) => points[i * every], () => colour, 0.006);
        });
    }

    resize(width, height, ratio) {
        this.renderer.setPixelRatio(Math.min(ratio, 2));
        this.renderer.setSize(width, height, false);
        this.eye.aspect = width / height;
        this.eye.updateProjectionMatrix();
    }

    /* The place of the laboratory at a height that is seen at a place of the picture, given as shares of its sides. */
    placeAt(across, down, z) {
        this.eye.updateMatrixWorld();
        const eye = this.eye.position, towards = new Vector3(2 * across - 1, 1 - 2 * down, 0.5).unproject(this.eye).sub(eye);
        return [eye.x, eye.y].map((v, i) => v + ((z - eye.z) / towards.z) * towards.getComponent(i));
    }

    draw({ rows, trails, range, camera, arrows }) {
        const row = rows[0], riding = camera.mode === "magnet";
        this.turning.rotation.z = 2 * Math.PI * row[COLUMN.magnet];
        const middle = this.setup.follows ? [row[COLUMN.x], row[COLUMN.y]] : undefined;
        const look = camera.look(row, this.setup.radii[0], this.setup.hull, this.eye.aspect, FOV, middle);
        this.eye.position.set(...look.eye);
        this.eye.up.set(...look.up);
        this.eye.lookAt(...look.target);
        rows.forEach((own, i) => this.showBead(this.beads[i], own, trails[i], range, riding, i));
        if (this.wave) {
            const { mesh, texture, side } = this.wave, x = row[COLUMN.x];
            mesh.position.x = x;
            mesh.position.y = row[COLUMN.y];
            texture.offset.x = (x - side / 2) / this.setup.wave.length - row[COLUMN.turns] + (this.setup.wave.sign < 0 ? 0.5 : 0);
        }
        this.showTouches(rows);
        this.point(row, arrows);
        this.renderer.render(this.scene, this.eye);
    }

    showBead({ ball, shadow, ribbon, ring }, row, trail, range, riding, index) {
        const { setup } = this, x = row[COLUMN.x], y = row[COLUMN.y], z = row[COLUMN.z];
        ball.position.set(x, y, z);
        ball.quaternion.set(...row.subarray(COLUMN.turn, COLUMN.turn + 4)).multiply(this.poleTurn);
        shadow.position.set(x, y, 0.006);
        ring.position.set(x, y, z);
        ring.quaternion.copy(this.eye.quaternion);
        const places = riding ? trail.turning : trail.lab, c = range[1] - range[0], low = setup.plate === "flat" ? undefined : setup.plate === "bowl" ? setup.radii[index] : 0;
        const at = (i) => (trail.first + i) % trail.room, under = (height) => (low === undefined ? undefined : height - low + 0.004);
        const here = [...(riding ? [row[COLUMN.r] * Math.cos(row[COLUMN.phi]), row[COLUMN.r] * Math.sin(row[COLUMN.phi])] : [x, y]), under(z)];
        const own = setup.colours && new Color(setup.colours[index]).toArray();
        const colour = (i) => {
            const value = trail.value[at(Math.min(i, trail.count - 1))];
            const full = own || PALETTE[Math.floor(255 * Math.max(0, Math.min(1, (value - range[0]) / c)))] || PALETTE[0];
            const age = 1 - i / (trail.count + 1), fresh = 1 - OLD * age * age; /* the oldest part fades */
            return full.map((v, k) => fresh * v + (1 - fresh) * BACK[k]);
        };
        ribbon.fill(trail.count + 1, (i) => (i < trail.count ? [places[2 * at(i)], places[2 * at(i) + 1], under(trail.height[at(i)])] : here), colour, 0.011);
        ribbon.mesh.rotation.z = riding ? this.turning.rotation.z : 0;
    }

    /* A dot where two beads touch. */
    showTouches(rows) {
        const { radii } = this.setup;
        let used = 0;
        rows.forEach((row, i) => rows.slice(i + 1).forEach((other, k) => {
            const j = i + 1 + k;
            if (!(Math.floor(row[COLUMN.touches] / 2 ** j) % 2))
                return;
            if (used === this.dots.length) {
                this.dots.push(new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ color: TOUCH, depthTest: false })));
                this.dots.at(-1).renderOrder = 4;
                this.scene.add(this.dots.at(-1));
            }
            const dot = this.dots[used], share = radii[i] / (radii[i] + radii[j]);
            dot.position.set(...["x", "y", "z"].map((name) => row[COLUMN[name]] + share * (other[COLUMN[name]] - row[COLUMN[name]])));
            dot.scale.setScalar(0.18 * radii[i]);
            used += 1;
        }));
        this.dots.forEach((dot, i) => {
            dot.visible = i < used;
        });
    }

    point(row, wanted) {
        const eps = this.setup.radii[0], from = [row[COLUMN.x], row[COLUMN.y], row[COLUMN.z]];
        const vectors = {
            moment: Array.from(row.subarray(COLUMN.n, COLUMN.n + 3), (v) => 3.2 * eps * v),
            field: Array.from(row.subarray(COLUMN.b, COLUMN.b + 3), (v) => (3.2 * eps * v) / this.setup.fieldScale),
            friction: [FRICTION * eps * row[COLUMN.force], FRICTION * eps * row[COLUMN.force + 1], 0],
            load: [0, 0, LOAD * eps * row[COLUMN.load]],
        };
        for (const [name, arrow] of Object.entries(this.arrows)) {
            arrow.group.visible = wanted.has(name);
            if (wanted.has(name))
                arrow.point(name === "friction" ? [from[0], from[1], 0.02] : from, vectors[name], 0.09 * eps);
        }
    }
}
