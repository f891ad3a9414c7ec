//! Section III, rotations: eqs. (1)-(5).

equations! {
    "(1)" "The orientation of a bar is three turns, one after the other (Bryan angles): about x by ψ, \
               about the turned y by θ, about the twice turned z by φ."
        r"[A_i] = [\psi_i]\,[\theta_i]\,[\varphi_i], \quad i = \range{1,3}";
    "(2)" "The turn by ψ about the x axis."
        r"[\psi_i] = \begin{bmatrix} 1 & 0 & 0 \\ 0 & \cos\psi_i & -\sin\psi_i \\ 0 & \sin\psi_i & \cos\psi_i \end{bmatrix}";
    "(3)" "The turn by θ about the y axis."
        r"[\theta_i] = \begin{bmatrix} \cos\theta_i & 0 & \sin\theta_i \\ 0 & 1 & 0 \\ -\sin\theta_i & 0 & \cos\theta_i \end{bmatrix}";
    "(4)" "The turn by φ about the z axis."
        r"[\varphi_i] = \begin{bmatrix} \cos\varphi_i & -\sin\varphi_i & 0 \\ \sin\varphi_i & \cos\varphi_i & 0 \\ 0 & 0 & 1 \end{bmatrix}, \quad i = \range{1,3}";
    "(5)" "The product of (1), multiplied out; c and s are cosine and sine. Its first column is the direction of the bar."
        r"[A_i] = \begin{bmatrix} c\theta_i\, c\varphi_i & -c\theta_i\, s\varphi_i & s\theta_i \\ s\psi_i\, s\theta_i\, c\varphi_i + c\psi_i\, s\varphi_i & -s\psi_i\, s\theta_i\, s\varphi_i + c\psi_i\, c\varphi_i & -s\psi_i\, c\theta_i \\ -c\psi_i\, s\theta_i\, c\varphi_i + \wrong{s\psi_i\, s\theta_i} & c\psi_i\, s\theta_i\, s\varphi_i + s\psi_i\, c\varphi_i & \wrong{c\psi_i\, c\varphi_i} \end{bmatrix}, \quad i = \range{1,3}"
        => r"[A_i] = \begin{bmatrix} c\theta_i\, c\varphi_i & -c\theta_i\, s\varphi_i & s\theta_i \\ s\psi_i\, s\theta_i\, c\varphi_i + c\psi_i\, s\varphi_i & -s\psi_i\, s\theta_i\, s\varphi_i + c\psi_i\, c\varphi_i & -s\psi_i\, c\theta_i \\ -c\psi_i\, s\theta_i\, c\varphi_i + \fixed{s\psi_i\, s\varphi_i} & c\psi_i\, s\theta_i\, s\varphi_i + s\psi_i\, c\varphi_i & \fixed{c\psi_i\, c\theta_i} \end{bmatrix}, \quad i = \range{1,3}";
}
