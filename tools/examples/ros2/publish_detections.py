#!/usr/bin/env python3
"""A node of ROS 2 that publishes what a network sees: a straight road with one lane.

Needs the package laneloom_msgs in the workspace, and a service with ros2.enabled; poses come from the node that
publishes nav_msgs/Odometry.
"""
import rclpy
from laneloom_msgs.msg import Detection, Detections, Point
from rclpy.node import Node

LANELINE, STYLE_SOLID = 0, 1  # MarkingType, MarkingStyle


def laneline(left_m):
    """A line beside the car in the body frame (x forward, y left, z up)."""
    points = [Point(x=5.0 * i - 5.0, y=left_m, z=0.0) for i in range(8)]
    return Detection(type=LANELINE, style=STYLE_SOLID, confidence=0.9, points=points)


class Perception(Node):
    def __init__(self):
        super().__init__("example_perception")
        self.publisher = self.create_publisher(Detections, "laneloom/detections", 1)
        self.session = self.get_clock().now().nanoseconds  # another value after a restart
        self.sequence = 0
        self.create_timer(0.1, self.publish)

    def publish(self):
        self.sequence += 1
        frame = Detections(source="example", detections=[laneline(1.75), laneline(-1.75)])
        frame.header.stamp_ns = self.get_clock().now().nanoseconds  # of the image, by the clock of the poses
        frame.header.sequence_number = self.sequence
        frame.header.session_id = self.session
        frame.header.frame_id = "base_link"
        self.publisher.publish(frame)


def main():
    rclpy.init()
    rclpy.spin(Perception())


if __name__ == "__main__":
    main()
