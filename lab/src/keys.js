/* keys.js - what keys do where nothing is typed. */
import { CAMERAS } from "./camera.js";

export function listenKeys(lab) {
    document.addEventListener("keydown", (event) => {
        const tag = event.target.tagName;
        if (event.ctrlKey || event.metaKey || event.altKey || ["SELECT", "TEXTAREA"].includes(tag) || (tag === "INPUT" && event.target.type !== "range"))
            return;
        const camera = CAMERAS[Number(event.key) - 1];
        if (event.key === " " && !["BUTTON", "SUMMARY"].includes(tag))
            lab.play(!lab.playing);
        else if (event.key === ".")
            lab.step();
        else if (event.key.toLowerCase() === "r")
            lab.restart();
        else if (camera)
            lab.panels.chooseCamera(camera);
        else if (event.key === "5")
            lab.lesson.toggle();
        else if (event.key.toLowerCase() === "f")
            lab.panels.fillScreen();
        else
            return;
        event.preventDefault();
    });
}
