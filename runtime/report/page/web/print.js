// The page on paper: in light, at the width of a sheet, with an image in place of each canvas. A
// canvas reaches a PDF as hundreds of nested soft masks, of which most viewers draw nothing.

/** Pixels of an image per pixel of the page. */
const paperScale = 3;

class Paper {
  /** @type {string | undefined} */ theme = undefined;
  /** @type {Element[]} */ images = [];
  /** @type {HTMLElement[]} */ shrunk = [];
  ready = false;

  /** Twice asked is once done: browsers tell by an event, by a media query or by both. */
  prepare() {
    if (this.ready) return;
    document.dispatchEvent(new Event("paper")); // what was not near yet is drawn
    this.ready = true;
    const root = document.documentElement;
    this.theme = root.dataset.theme;
    root.dataset.theme = "light";
    root.classList.add("for-print");
    repaint();
    for (const canvas of document.querySelectorAll(".chart canvas:first-of-type, .stage canvas"))
      this.imageOf(/** @type {HTMLCanvasElement} */ (canvas));
    for (const box of document.querySelectorAll(".scroll")) this.shrink(box);
  }

  /** @param {HTMLCanvasElement} canvas */
  imageOf(canvas) {
    if (canvas.width === 0 || canvas.height === 0) return;
    const image = html("img", { class: "on-paper", alt: "", src: canvas.toDataURL() });
    image.style.width = canvas.style.width;
    image.style.height = canvas.style.height;
    canvas.after(image);
    this.images.push(image);
  }

  /** A table that is wider than the sheet comes down to it. @param {Element} box */
  shrink(box) {
    const inner = box.querySelector("table");
    if (!inner || inner.offsetWidth <= box.clientWidth) return;
    inner.style.setProperty("zoom", String(box.clientWidth / inner.offsetWidth));
    this.shrunk.push(inner);
  }

  restore() {
    if (!this.ready) return;
    this.ready = false;
    const root = document.documentElement;
    if (this.theme) root.dataset.theme = this.theme;
    else delete root.dataset.theme;
    root.classList.remove("for-print");
    this.images.splice(0).forEach((image) => image.remove());
    this.shrunk.splice(0).forEach((inner) => inner.style.removeProperty("zoom"));
    repaint();
  }
}

const paper = new Paper();

function fitPrint() {
  window.addEventListener("beforeprint", () => paper.prepare());
  window.addEventListener("afterprint", () => paper.restore());
  matchMedia("print").addEventListener("change", ({ matches }) => {
    if (matches) paper.prepare();
    else paper.restore();
  });
}
