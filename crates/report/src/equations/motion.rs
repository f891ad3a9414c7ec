//! Sections VI and VII, motion and equilibrium: eqs. (33)-(41).

equations! {
    "(33)" "The equation of motion: inertia and multipliers against the forces, and the constraints differentiated twice. Printed without the bracket that joins its matrix, without the lower rows of that, and with [B]{q}, which without its two dots is no derivative of the constraints."
        r"\wrong{\begin{bmatrix} [\mathbf{M}_1] & [\mathbf{0}_{6,6}] & [\mathbf{0}_{6,6}] \\ {}[\mathbf{0}_{6,6}] & [\mathbf{M}_2] & [\mathbf{0}_{6,6}] \\ {}[\mathbf{0}_{6,6}] & [\mathbf{0}_{6,6}] & [\mathbf{M}_3] \end{bmatrix} - [\mathbf{B}]^T} \begin{bmatrix} \{\ddot{\mathbf{q}}\} \\ \{\boldsymbol{\lambda}\} \end{bmatrix} = \begin{bmatrix} \{\mathbf{F}_{q_1}\} + \{\tilde{\mathbf{F}}_{q_1}\} \\ \{\mathbf{F}_{q_2}\} + \{\tilde{\mathbf{F}}_{q_2}\} \\ \{\mathbf{F}_{q_3}\} + \{\tilde{\mathbf{F}}_{q_3}\} \\ \wrong{-[\mathbf{B}] \{\mathbf{q}\}} \end{bmatrix}"
        => r"\begin{bmatrix} [\mathbf{M}_1] & [\mathbf{0}_{6,6}] & [\mathbf{0}_{6,6}] &  \\ {}[\mathbf{0}_{6,6}] & [\mathbf{M}_2] & [\mathbf{0}_{6,6}] & -[\mathbf{B}]^T \\ {}[\mathbf{0}_{6,6}] & [\mathbf{0}_{6,6}] & [\mathbf{M}_3] &  \\ & \fixed{[\mathbf{B}]} & & \fixed{[\mathbf{0}_{12,12}]} \end{bmatrix} \begin{bmatrix} \{\ddot{\mathbf{q}}\} \\ \{\boldsymbol{\lambda}\} \end{bmatrix} = \begin{bmatrix} \{\mathbf{F}_{q_1}\} + \{\tilde{\mathbf{F}}_{q_1}\} \\ \{\mathbf{F}_{q_2}\} + \{\tilde{\mathbf{F}}_{q_2}\} \\ \{\mathbf{F}_{q_3}\} + \{\tilde{\mathbf{F}}_{q_3}\} \\ \fixed{-[\dot{\mathbf{B}}] \{\dot{\mathbf{q}}\}} \end{bmatrix}";
    "(34)" "The generalised force on a bar: a force at its centre, then the moments that go with its angles."
        r"\{\mathbf{F}_{q_i}\} = \begin{bmatrix} \{\mathbf{F}_{s_i}\} \\ \{\mathbf{F}_{\beta_i}\} \end{bmatrix}, \quad i = \range{1,3}";
    "(35)" "The only force is the bar's weight, straight down."
        r"\{\mathbf{F}_{s_i}\} = [0 \;\; 0 \;\; -m_i g]^T, \quad i = \range{1,3}";
    "(36)" "A weight at the centre has no moment about it."
        r"\{\mathbf{F}_{\beta_i}\} = [0 \;\; 0 \;\; 0]^T, \quad i = \range{1,3}";
    "(37)" "The inertial forces that go with the squares of the rates, in the same order."
        r"\{\tilde{\mathbf{F}}_{q_i}\} = \begin{bmatrix} \{\tilde{\mathbf{F}}_{s_i}\} \\ \{\tilde{\mathbf{F}}_{\beta_i}\} \end{bmatrix}, \quad i = \range{1,3}";
    "(38)" "The part of them at the centre, zero because of (28). Without the bracket a matrix is added to a column."
        r"\{\tilde{\mathbf{F}}_{s_i}\} = \wrong{-[\mathbf{A}_i][\mathbf{S}_i]^T[\dot{\mathbf{Q}}_i] + [\dot{\mathbf{A}}_i][\mathbf{S}_i]^T[\mathbf{Q}_i]} \begin{bmatrix} \dot\psi_i \\ \dot\theta_i \\ \dot\varphi_i \end{bmatrix} = \begin{bmatrix} 0 \\ 0 \\ 0 \end{bmatrix}, \quad i = \range{1,3}"
        => r"\{\tilde{\mathbf{F}}_{s_i}\} = \fixed{-\left( [\mathbf{A}_i][\mathbf{S}_i]^T[\dot{\mathbf{Q}}_i] + [\dot{\mathbf{A}}_i][\mathbf{S}_i]^T[\mathbf{Q}_i] \right)} \begin{bmatrix} \dot\psi_i \\ \dot\theta_i \\ \dot\varphi_i \end{bmatrix} = \begin{bmatrix} 0 \\ 0 \\ 0 \end{bmatrix}, \quad i = \range{1,3}";
    "(39)" "The part of them about the centre (gyroscopic). Besides the bracket, a dot too many: with it the second term has a rate more than the first."
        r"\{\tilde{\mathbf{F}}_{\beta_i}\} = \wrong{-[\mathbf{Q}_i]^T[\mathbf{J}_{C_i}][\dot{\mathbf{Q}}_i] + [\dot{\mathbf{Q}}_i]^T[\boldsymbol{\omega}_i][\mathbf{J}_{C_i}][\mathbf{Q}_i]} \begin{bmatrix} \dot\psi_i \\ \dot\theta_i \\ \dot\varphi_i \end{bmatrix}, \quad i = \range{1,3}"
        => r"\{\tilde{\mathbf{F}}_{\beta_i}\} = \fixed{-\left( [\mathbf{Q}_i]^T[\mathbf{J}_{C_i}][\dot{\mathbf{Q}}_i] + [\mathbf{Q}_i]^T[\boldsymbol{\omega}_i][\mathbf{J}_{C_i}][\mathbf{Q}_i] \right)} \begin{bmatrix} \dot\psi_i \\ \dot\theta_i \\ \dot\varphi_i \end{bmatrix}, \quad i = \range{1,3}";
    "(40)" "At rest the multipliers alone carry the load. This is the equation that the second solution solves."
        r"-[\mathbf{B}]^T \{\boldsymbol{\lambda}\} = [\mathbf{T}]";
    "(41)" "The load: three weights. The dots pass over bar 2, as those of (21) do; written out in (xxiii), no weight is missing."
        r"[\mathbf{T}] = [0 \;\; 0 \;\; -m_1 g \;\; 0 \;\; \dots \;\; 0 \;\; -m_3 g \;\; 0 \;\; 0 \;\; 0]^T";
}
