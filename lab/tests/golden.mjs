/* golden.mjs - the golden hashes of test_golden.c, computed by the library in WebAssembly: the same trajectories,
 * called one by one, and the same hash.  Used in node and, as text, in the browser. */
export function goldenHashes(core) {
    const MASK = (1n << 64n) - 1n;
    let hash = 14695981039346656037n, jacobians = hash;
    const view = new DataView(new ArrayBuffer(8));
    const add = (old, numbers) => {
        let h = old;
        for (const value of numbers) {
            view.setFloat64(0, value, true);
            for (let byte = 0; byte < 8; ++byte)
                h = ((h ^ BigInt(view.getUint8(byte))) * 1099511628211n) & MASK;
        }
        return h;
    };
    const info = () => Array.from(core.doubles(core.c.lab_flow_info(core.bead), 14));
    for (let which = 0; which < 12; ++which) {
        core.reset();
        core.set("drive.omega", 0.18 + 0.03 * which);
        core.set("model.dynamics", which & 1 ? "farago2020" : "rigid");
        core.set("friction.law", which & 2 ? "none" : "viscous");
        core.set("bead.material", ["hard", "paramagnetic", "mixed"][Math.floor(which / 4)]);
        core.set("bead.a", 1e-3);
        core.set("bead.b", -5e-4);
        core.set("start.phi", 3 + 37 * which);
        core.set("magnet.lines", which < 10 ? 5 : which);
        core.start(which % 3 === 2 ? 1e-4 : 0);
        hash = add(hash, core.doubles(core.c.lab_start_state(core.bead), 10));
        for (let i = 0; i < 4; ++i) {
            core.check(core.c.lab_flow_section(core.bead, 120, 1));
            const now = info();
            hash = add(hash, now.slice(0, 10));
            hash = add(hash, now.slice(10, 14));
        }
        core.check(core.c.lab_flow_section(core.bead, 240, 0));
        hash = add(hash, info().slice(0, 10));
        jacobians = add(jacobians, core.doubles(core.c.lab_flow_jacobian(core.bead), 100));
    }
    core.reset();
    return { trajectories: hash.toString(16), jacobians: jacobians.toString(16) };
}
