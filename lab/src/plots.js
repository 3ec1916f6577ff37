/* plots.js - small plots on a canvas: points and lines over two axes with round ticks. */

import { shown } from "./texts.js";

const INK = { light: { text: "#33404d", grid: "#dde3ea", frame: "#8c99a6" }, dark: { text: "#c4ced9", grid: "#2b3644", frame: "#5d6b7a" } };
const MARGIN = { left: 52, right: 10, top: 24, bottom: 36 };

/* Round steps of about `count` pieces of a range. */
export function ticks(least, most, count) {
    const raw = (most - least) / count, power = 10 ** Math.floor(Math.log10(raw)), steps = [1, 2, 5, 10];
    const step = power * steps.find((s) => s * power >= raw * 0.999);
    const marks = [];
    for (let i = Math.ceil(least / step - 1e-9); i * step <= most + 1e-9 * step; ++i)
        marks.push(Math.round(i * step * 1e9) / 1e9 + 0);
    return marks;
}

/* A range about values, a little wider; of one value alone, about it. */
export function rangeOf(values, least = 1e-9) {
    let lo = Infinity, hi = -Infinity;
    for (const value of values)
        if (Number.isFinite(value)) {
            lo = Math.min(lo, value);
            hi = Math.max(hi, value);
        }
    if (lo > hi)
        return [0, 1];
    const spare = Math.max(0.06 * (hi - lo), least);
    return [lo - spare, hi + spare];
}

export class Plot {
    constructor(canvas) {
        this.canvas = canvas;
        this.pen = canvas.getContext("2d");
    }

    begin() {
        const { canvas, pen } = this, box = canvas.getBoundingClientRect(), ratio = window.devicePixelRatio || 1;
        const width = Math.round(box.width * ratio), height = Math.round(box.height * ratio);
        if (canvas.width !== width || canvas.height !== height)
            [canvas.width, canvas.height] = [width, height];
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        pen.clearRect(0, 0, box.width, box.height);
        this.ink = !this.paper && window.matchMedia("(prefers-color-scheme: dark)").matches ? INK.dark : INK.light;
        [this.width, this.height] = [box.width, box.height];
        return box.width > 80 && box.height > 60;
    }

    /* A frame for x and y ranges, in a part of the canvas from `top` to `bottom` (shares of its height). */
    frame({ x, y, xLabel, yLabel, title, from = 0, to = 1, xTicks = true, square = false, every }) {
        const { pen, ink } = this;
        let left = MARGIN.left, right = this.width - MARGIN.right;
        let top = from * this.height + MARGIN.top, bottom = to * this.height - (xTicks ? MARGIN.bottom : 8);
        if (square) {
            const side = Math.min(right - left, bottom - top);
            const middle = (left + right) / 2;
            [left, right, bottom] = [middle - side / 2, middle + side / 2, top + side];
        }
        this.box = { left, right, top, bottom, x, y };
        pen.font = "12px system-ui, sans-serif";
        pen.lineWidth = 1;
        const across = every ? ticks(x[0], x[1], (x[1] - x[0]) / every) : ticks(x[0], x[1], Math.max(2, Math.min(8, (right - left) / 60)));
        pen.textAlign = "center";
        for (const value of across) {
            const at = this.atX(value);
            this.line(ink.grid, [[at, top], [at, bottom]]);
            pen.fillStyle = ink.text;
            if (xTicks)
                pen.fillText(shown(value), at, bottom + 15);
        }
        pen.textAlign = "right";
        for (const value of ticks(y[0], y[1], Math.max(2, Math.min(6, (bottom - top) / 30)))) {
            const at = this.atY(value);
            this.line(ink.grid, [[left, at], [right, at]]);
            pen.fillStyle = ink.text;
            pen.fillText(shown(value), left - 5, at + 4);
        }
        pen.strokeStyle = ink.frame;
        pen.strokeRect(left, top, right - left, bottom - top);
        pen.fillStyle = ink.text;
        this.words(title || yLabel || "", left, left, top - 8);
        if (xTicks && xLabel)
            this.words(xLabel, (left + right - pen.measureText(xLabel).width) / 2, 2, bottom + 31);
    }

    /* A line of words from a place on, if it fits; else it begins farther left, at `least` at most, and is narrowed. */
    words(text, left, least, y) {
        const { pen, width } = this, right = width - 2, wide = pen.measureText(text).width;
        pen.textAlign = "left";
        pen.fillText(text, Math.max(least, Math.min(left, right - wide)), y, right - least);
    }

    atX(value) {
        const { left, right, x } = this.box;
        return left + ((value - x[0]) / (x[1] - x[0])) * (right - left);
    }

    atY(value) {
        const { top, bottom, y } = this.box;
        return bottom - ((value - y[0]) / (y[1] - y[0])) * (bottom - top);
    }

    line(colour, places, width = 1) {
        const { pen } = this;
        pen.strokeStyle = colour;
        pen.lineWidth = width;
        pen.beginPath();
        places.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
        pen.stroke();
    }

    clip(draw) {
        const { pen, box } = this;
        pen.save();
        pen.beginPath();
        pen.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
        pen.clip();
        draw();
        pen.restore();
    }

    dots(points, colour, size = 1.6) {
        this.clip(() => {
            this.pen.fillStyle = colour;
            for (const [x, y] of points)
                this.pen.fillRect(this.atX(x) - size, this.atY(y) - size, 2 * size, 2 * size);
        });
    }

    disc(x, y, radius, fill, rim) {
        const { pen } = this;
        pen.beginPath();
        pen.arc(this.atX(x), this.atY(y), radius, 0, 2 * Math.PI);
        pen.fillStyle = fill;
        pen.fill();
        if (rim) {
            pen.strokeStyle = rim;
            pen.lineWidth = 1.5;
            pen.stroke();
        }
    }

    note(text) {
        this.pen.fillStyle = this.ink.text;
        this.pen.font = "13px system-ui, sans-serif";
        this.words(text, (this.width - this.pen.measureText(text).width) / 2, 2, this.height / 2);
    }
}

/* Colours of regimes, told apart by shape of words in the legend too; one that has none yet is grey. */
const REGIME_COLOURS = {
    locked: "#4a7fc1", librating: "#8a63b8", "counter-rotating": "#d2622a", corotating: "#2a9d74", chaotic: "#b0a21d",
    ejected: "#8d8d8d", lifted: "#555555", undecided: "#b9b9b9",
};
export const regimeColour = (name) => REGIME_COLOURS[name] || "#888888";
