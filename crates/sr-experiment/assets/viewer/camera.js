// Which part of the pictures is seen: one state for all of them, in parts of their width and height.

class Camera {
  constructor(changed) {
    this.changed = changed;
    this.x = 0.5;
    this.y = 0.5;
    this.zoom = 1;
  }

  fit() {
    this.x = this.y = 0.5;
    this.zoom = 1;
    this.changed();
  }

  // Moves by parts of the picture.
  pan(dx, dy) {
    this.x = clamp(this.x + dx, 0, 1);
    this.y = clamp(this.y + dy, 0, 1);
    this.changed();
  }

  // Zooms such that the point (x, y) of the picture stays where it is.
  zoomAt(x, y, factor) {
    const zoom = clamp(this.zoom * factor, 1, 400);
    const kept = this.zoom / zoom;
    this.zoom = zoom;
    this.x = clamp(x + (this.x - x) * kept, 0, 1);
    this.y = clamp(y + (this.y - y) * kept, 0, 1);
    if (zoom === 1) this.x = this.y = 0.5;
    this.changed();
  }

  // Where a picture of some size lies on a canvas: left, top, and pixels of the canvas a pixel.
  place(width, height, canvas) {
    const scale = this.zoom * Math.min(canvas.width / width, canvas.height / height);
    return {
      scale,
      left: canvas.width / 2 - this.x * width * scale,
      top: canvas.height / 2 - this.y * height * scale,
    };
  }
}
