/* loader.js - the first script of the page: unpacks the others, which are gzip in base64 as the library is, and begins. */

/* What an element of the page holds, unpacked. */
window.festoonUnpack = (id) => {
    const bytes = Uint8Array.from(atob(document.getElementById(id).textContent.trim()), (c) => c.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")));
};

async function load() {
    const text = await window.festoonUnpack("program").text(), script = document.createElement("script");
    script.src = URL.createObjectURL(new Blob([text], { type: "text/javascript;charset=utf-8" }));
    await new Promise((resolve, reject) => {
        script.onload = resolve;
        script.onerror = () => reject(new Error("its scripts could not be unpacked"));
        document.head.append(script);
    });
    URL.revokeObjectURL(script.src);
    return window.festoonLab.begin();
}

window.festoonLab = {};
window.festoonPage = `<!doctype html>${document.documentElement.outerHTML}`; /* before anything has changed it: beside.js needs it */
window.festoonLab.ready = load();
window.festoonLab.ready.catch((error) => {
    const { couldNotBegin } = window.festoonLab;
    if (couldNotBegin)
        couldNotBegin(error);
    else
        document.getElementById("notice").textContent = `The page could not begin: ${error.message}`; /* no other language is unpacked yet */
});
